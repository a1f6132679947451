// determinism_driver [THREADS]: a line "name hash" for each scene, where the hash covers the file's bytes and
// the bits of the default mesh, of a finer mesh, and of the field at a few points. It must be the same
// everywhere.

#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "scenes.h"

#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

// FNV-1a, 64 bits.
class Hash {
  public:
    void add(std::uint64_t value, int bytes = 8) {
        for (int i = 0; i < bytes; ++i) state_ = (state_ ^ ((value >> (8 * i)) & 0xFF)) * 0x100000001B3ULL;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const pfgeom::Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) add(v[axis]);
    }
    void add(const pfgeom::TriangleMesh& mesh) {
        for (const auto& v : mesh.vertices) add(v);
        for (const auto& face : mesh.faces) {
            for (const std::int32_t row : face) add(static_cast<std::uint64_t>(row), 4);
        }
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0xCBF29CE484222325ULL;
};

std::uint64_t hash_of(const scenes::Scene& scene, const pfgeom::Task& task) {
    Hash hash;
    const auto compressed = pfgeom::compress(scene.mesh, {.tolerance = scene.tolerance}, task);
    for (const std::uint8_t byte : compressed.bytes) hash.add(byte, 1);

    const auto model = pfgeom::decode(compressed.bytes);
    if (!model) std::exit(1);
    hash.add(pfgeom::to_mesh(*model, {}, task));
    pfgeom::MeshOptions finer;
    finer.resolution = 48;
    hash.add(pfgeom::to_mesh(*model, finer, task));

    const pfgeom::ModelField field(*model);
    for (const auto& v : scene.mesh.vertices) {
        hash.add(field.value(v * 0.97));
        hash.add(field.gradient(v * 0.97));
    }
    return hash.value();
}

}  // namespace

int main(int argc, char** argv) {
    pfgeom::Task task;
    task.threads = argc > 1 ? std::atoi(argv[1]) : 1;
    const std::string only = argc > 2 ? argv[2] : "";
    try {
        for (const auto& scene : scenes::all()) {
            if (!only.empty() && scene.name != only) continue;
            std::printf("%-12s %016" PRIx64 "\n", scene.name.c_str(), hash_of(scene, task));
            std::fflush(stdout);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "determinism_driver: %s\n", error.what());
        return 1;
    }
}
