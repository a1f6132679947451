// Files of every version of the format, kept for ever: they decode to what they decoded to when they were
// made.
#include "codec/model_hash.h"
#include "codec/random_model.h"
#include "combinations.h"
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

std::vector<fs::path> golden_folders() {
    const fs::path all = fs::path(__FILE__).parent_path() / ".." / ".." / "golden";
    return {all / "v1", all / "v2", all / "v3", all / "combined"};
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
    models["painted"] = test::painted(tree, 5);
    for (std::uint64_t seed = 0; seed < 10; ++seed)
        models["random" + std::to_string(seed)] = test::random_model(seed);
    return models;
}

// Those of version 2: each kind of object in several places.
std::map<std::string, Model> placed_models() {
    std::map<std::string, Model> models;
    for (const auto& [name, model] : golden_models())
        models[name] = test::with_placements(model, name.size());
    models["painted"] = test::painted(models["tree"], 6);
    return models;
}

// Those of version 3: a mirrored mesh part beside each of the others, or a sheet that is cut.
std::map<std::string, Model> mirrored_models() {
    std::map<std::string, Model> models;
    for (const auto& [name, model] : golden_models()) {
        if (model.materials.empty()) models[name] = test::with_mirrored_part(model, name.size());
    }
    models["painted"] = test::painted(models["tree"], 7);
    models["placed"] = test::with_placements(models["curved"], 8);
    for (std::uint64_t seed = 0; seed < 3; ++seed)
        models["cut" + std::to_string(seed)] = test::with_cut_sheet(test::random_model(seed), seed);
    return models;
}

// With the section of a combination: each operation, a transform alone, nested ones.
std::map<std::string, Model> combined_models() {
    std::map<std::string, Model> models;
    Random random(2026);
    const Model a = test::ball(), b = test::tree_model(1), c = test::mesh_ball();
    models["union"] = a | b;
    models["intersection"] = b & c;
    models["difference"] = c - a;
    models["moved"] = transformed(c, test::random_affine(random));
    for (std::uint64_t seed = 0; seed < 9; ++seed)
        models["nested" + std::to_string(seed)] = test::random_combination(seed);
    return models;
}

TEST(Golden, OldFilesDecodeToWhatTheyWere) {
    for (const fs::path& folder : golden_folders()) {
        const auto manifest = read_manifest(folder);
        EXPECT_GE(manifest.size(), 12U) << folder;
        for (const auto& [file, hash] : manifest) {
            const Bytes bytes = read(folder / file);
            const Result<Model> model = decode(bytes);
            ASSERT_TRUE(model) << file << ": " << name(model.status());
            EXPECT_EQ(test::hash_of(*model), hash) << file;
            EXPECT_EQ(encode(*model), bytes) << file;
        }
    }
}

// The three smallest of each version.
std::vector<fs::path> small_goldens() {
    std::vector<fs::path> small;
    for (const fs::path& folder : golden_folders()) {
        std::multimap<std::size_t, fs::path> by_size;
        for (const auto& [file, hash] : read_manifest(folder))
            by_size.emplace(fs::file_size(folder / file), folder / file);
        for (int i = 0; const auto& [size, file] : by_size) {
            if (++i <= 3) small.push_back(file);
        }
    }
    return small;
}

TEST(Golden, NoFlippedBitAndNoPrefixPasses) {
    const std::vector<fs::path> files = small_goldens();
    EXPECT_EQ(files.size(), 12U);
    for (const fs::path& file : files) {
        const Bytes bytes = read(file);
        const std::size_t size = bytes.size();
        for (std::size_t bit = 0; bit < size * 8; ++bit) {
            Bytes damaged = bytes;
            damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
            EXPECT_FALSE(decode(damaged)) << file << " bit " << bit;
        }
        for (std::size_t n = 0; n < size; ++n)
            EXPECT_FALSE(decode(std::span(bytes).first(n))) << file << " at " << n;
    }
}

// Makes golden files of version 2 or 3, or of combinations: PFGEOM_NEW_GOLDENS names their folder. Files that
// lie there already are taken into the manifest too. Never to be used for a version that was released.
TEST(Golden, Make) {
    const char* folder = std::getenv("PFGEOM_NEW_GOLDENS");
    if (folder == nullptr) GTEST_SKIP() << "only on demand";
    fs::create_directories(folder);
    const fs::path kind = fs::path(folder).filename();
    for (const auto& [file, model] : kind == "combined" ? combined_models()
                                     : kind == "v3"     ? mirrored_models()
                                                        : placed_models())
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
