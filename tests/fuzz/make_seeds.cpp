// Writes the seeds of the fuzz targets: make_fuzz_seeds FOLDER
#include "combinations.h"
#include "pfgeom/codec/byte_writer.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/codec/header.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

void write(const fs::path& folder, const std::string& name, const Bytes& bytes) {
    fs::create_directories(folder);
    std::ofstream out(folder / name, std::ios::binary);
    for (const std::uint8_t b : bytes) out.put(static_cast<char>(b));
}

void write_model(const fs::path& folder, const std::string& name, const pfgeom::Model& model) {
    const Bytes file = pfgeom::encode(model);
    const auto envelope = pfgeom::open_envelope(file, {});
    write(folder / "file", name, file);
    write(folder / "header", name, file);
    write(folder / "file", name + ".stream", {envelope->stream.begin(), envelope->stream.end()});
    Bytes bits{static_cast<std::uint8_t>(file.size()), 250};
    bits.insert(bits.end(), envelope->stream.begin(), envelope->stream.end());
    write(folder / "entropy", name, bits);
}

void write_unknown_sections(const fs::path& folder) {
    for (const bool required : {false, true}) {
        const std::vector<pfgeom::Section> sections{
            {pfgeom::SectionId::names, false, {3, 'p', 'f', 'g'}},
            {static_cast<pfgeom::SectionId>(99), required, {1, 2, 3}}};
        write(folder / "header", required ? "required" : "optional",
              pfgeom::seal_envelope(Bytes(20, 7), sections));
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_fuzz_seeds FOLDER\n";
        return 2;
    }
    const fs::path folder = argv[1];
    write_model(folder, "ball", pfgeom::test::ball());
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const pfgeom::Model model = pfgeom::test::random_model(seed);
        write_model(folder, "model" + std::to_string(seed), model);
        if (seed % 4 == 0)
            write_model(folder, "painted" + std::to_string(seed), pfgeom::test::painted(model, seed));
    }
    for (std::uint64_t seed = 0; seed < 10; ++seed)
        write_model(folder, "combination" + std::to_string(seed), pfgeom::test::random_combination(seed));
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const pfgeom::Model model = pfgeom::test::random_model(seed);
        write_model(folder, "mirrored" + std::to_string(seed), pfgeom::test::with_mirrored_part(model, seed));
        write_model(folder, "cut" + std::to_string(seed), pfgeom::test::with_cut_sheet(model, seed));
    }
    for (int last_level = 2; last_level < 5; ++last_level) {
        pfgeom::Random random(static_cast<std::uint64_t>(last_level));
        pfgeom::Model model = pfgeom::test::ball();
        model.functions[0] = pfgeom::test::random_hierarchy(random, last_level);
        write_model(folder, "hierarchy" + std::to_string(last_level), model);
    }
    for (int depth = 1; depth < 7; ++depth) {
        pfgeom::Random random(static_cast<std::uint64_t>(depth));
        pfgeom::Model model = pfgeom::test::ball();
        model.functions.clear();
        model.objects[0].shape = pfgeom::test::random_tree(random, depth);
        write_model(folder, "tree" + std::to_string(depth), model);
    }
    write_unknown_sections(folder);
    return 0;
}
