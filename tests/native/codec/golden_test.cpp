// Files of every version of the format, kept for ever: they decode to what they decoded to when they were
// made.
#include "codec/model_hash.h"
#include "codec/random_model.h"
#include "pfgeom/codec/codec.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace pfgeom {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

fs::path golden_folder() {
    return fs::path(__FILE__).parent_path() / ".." / ".." / "golden" / "v1";
}

Bytes read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const Bytes& bytes) {
    std::ofstream out(path, std::ios::binary);
    for (const std::uint8_t b : bytes) out.put(static_cast<char>(b));
}

// A line for each file: name, hash of the model in hexadecimal.
std::map<std::string, std::uint64_t> read_manifest(const fs::path& folder) {
    std::map<std::string, std::uint64_t> manifest;
    std::ifstream in(folder / "MANIFEST");
    std::string file;
    for (std::uint64_t hash = 0; in >> file >> std::hex >> hash;) manifest[file] = hash;
    return manifest;
}

// The models that golden files are made of: each feature alone, then all together.
std::map<std::string, Model> golden_models() {
    std::map<std::string, Model> models;
    Random random(2018);
    models["ball"] = test::ball();
    for (const int last_level : {3, 5}) {
        Model& model = models["hierarchy" + std::to_string(last_level)] = test::ball();
        model.functions[0] = test::random_hierarchy(random, last_level);
    }
    Model& mesh = models["mesh"] = test::ball();
    mesh.functions.clear();
    mesh.objects[0].shape = test::random_mesh_part(random);
    Random random_bulges(2019);
    Model& curved = models["curved"] = mesh;
    curved.objects[0].shape =
        test::with_random_bulges(std::get<MeshPart>(mesh.objects[0].shape), random_bulges);
    Model& tree = models["tree"] = test::ball();
    tree.functions.clear();
    tree.objects[0].shape = test::random_tree(random, 6);
    Model& named = models["sections"] = test::ball();
    named.names = {"Kugel \xC3\xBC"};
    named.world_transform = {1, 0, 0, 2, 0, 0.5, 0, 3, 0, 0, -1, 4, 0, 0, 0, 1};
    named.face_groups = {0, 0, 0, 5, 5, 0};
    for (std::uint64_t seed = 0; seed < 10; ++seed)
        models["random" + std::to_string(seed)] = test::random_model(seed);
    return models;
}

TEST(Golden, OldFilesDecodeToWhatTheyWere) {
    const auto manifest = read_manifest(golden_folder());
    if (manifest.empty()) GTEST_SKIP() << "no golden files yet";
    EXPECT_GE(manifest.size(), 12U);
    for (const auto& [file, hash] : manifest) {
        const Bytes bytes = read(golden_folder() / file);
        const Result<Model> model = decode(bytes);
        ASSERT_TRUE(model) << file << ": " << name(model.status());
        EXPECT_EQ(test::hash_of(*model), hash) << file;
        EXPECT_EQ(encode(*model), bytes) << file;
    }
}

TEST(Golden, NoFlippedBitAndNoPrefixPasses) {
    std::multimap<std::size_t, std::string> by_size;
    for (const auto& [file, hash] : read_manifest(golden_folder())) {
        by_size.emplace(fs::file_size(golden_folder() / file), file);
    }
    if (by_size.empty()) GTEST_SKIP() << "no golden files yet";
    int files = 0;
    for (const auto& [size, file] : by_size) {
        if (++files > 3) break;
        const Bytes bytes = read(golden_folder() / file);
        for (std::size_t bit = 0; bit < size * 8; ++bit) {
            Bytes damaged = bytes;
            damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
            EXPECT_FALSE(decode(damaged)) << file << " bit " << bit;
        }
        for (std::size_t n = 0; n < size; ++n)
            EXPECT_FALSE(decode(std::span(bytes).first(n))) << file << " at " << n;
    }
}

// Makes golden files of a new version: PFGEOM_NEW_GOLDENS names their folder. Files that lie there already
// are taken into the manifest too. Never to be used for a version that was released.
TEST(Golden, Make) {
    const char* folder = std::getenv("PFGEOM_NEW_GOLDENS");
    if (folder == nullptr) GTEST_SKIP() << "only on demand";
    fs::create_directories(folder);
    for (const auto& [file, model] : golden_models())
        write(fs::path(folder) / (file + ".pfg"), encode(model));
    std::map<std::string, std::uint64_t> manifest;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".pfg") continue;
        const Result<Model> model = decode(read(entry.path()));
        ASSERT_TRUE(model) << entry.path();
        manifest[entry.path().filename().string()] = test::hash_of(*model);
    }
    std::ofstream out(fs::path(folder) / "MANIFEST");
    for (const auto& [file, hash] : manifest) out << file << ' ' << std::hex << hash << '\n';
}

}  // namespace
}  // namespace pfgeom
