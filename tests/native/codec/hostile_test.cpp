// Files made to do harm, most of them with right checksums: each must give a named status or a valid model,
// soon, and within the memory that its size allows.
#include "codec/counting_allocator.h"
#include "codec/random_model.h"
#include "combinations.h"
#include "pfgeom/base/random.h"
#include "pfgeom/codec/byte_writer.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/codec/crc32c.h"
#include "pfgeom/codec/header.h"
#include "pfgeom/codec/model_codec.h"
#include "pfgeom/codec/promise_codec.h"
#include "pfgeom/function/check.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pfgeom {
namespace {

using Bytes = std::vector<std::uint8_t>;
using test::ball;
using test::random_model;

// Without optimisation or with sanitizers the clock says nothing.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr double kMostSeconds = 0.05;
#else
constexpr double kMostSeconds = 5;
#endif

Model with_hierarchy(int last_level) {
    Random random(11);
    Model model = ball();
    model.functions[0] = test::random_hierarchy(random, last_level);
    return model;
}

Model with_mesh_part() {
    Random random(12);
    Model model = ball();
    model.functions.clear();
    model.objects[0].shape = test::random_mesh_part(random);
    return model;
}

Model with_curved_part() {
    Random random(14);
    Model model = with_mesh_part();
    model.objects[0].shape = test::with_random_bulges(std::get<MeshPart>(model.objects[0].shape), random);
    return model;
}

Model with_tree(int depth) {
    Random random(13);
    Model model = ball();
    model.functions.clear();
    model.objects[0].shape = test::random_tree(random, depth);
    model.promise.bound_functions = 1.8e-3;
    model.promise.functions_certified = true;
    return model;
}

std::vector<Bytes> small_files() {
    return {encode(ball()),
            encode(with_hierarchy(3)),
            encode(with_mesh_part()),
            encode(with_curved_part()),
            encode(with_tree(4)),
            encode(test::with_placements(ball(), 3)),
            encode(test::painted(with_tree(3), 15)),
            encode(ball() - transformed(with_tree(3), Affine{}))};
}

Bytes flipped(Bytes bytes, std::size_t bit) {
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    return bytes;
}

// With a right checksum.
Bytes resealed(Bytes bytes) {
    bytes.erase(bytes.end() - 4, bytes.end());
    ByteWriter out;
    out.append(bytes);
    out.u32(crc32c(bytes));
    return out.take();
}

std::size_t allowed_memory(std::size_t file_bytes) {
    const Limits limits;
    return limits.decode_base_bytes + limits.decode_bytes_per_byte * file_bytes;
}

// Decodes within time and memory. What is valid can be written again, and is then a file that stays as it is.
// (The bytes may differ from `bytes`: a mesh part's faces can be walked in other orders than the writer's.)
FormatStatus expect_harmless(const Bytes& bytes, const std::string& what, double most_seconds = 10) {
    const test::PeakMemory memory;
    const auto start = std::chrono::steady_clock::now();
    const Result<Model> model = decode(bytes);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_LE(memory.peak(), allowed_memory(bytes.size())) << what << ", " << bytes.size() << " bytes";
    EXPECT_LE(seconds.count(), most_seconds) << what << ", " << bytes.size() << " bytes";
    if (!model) return model.status();
    EXPECT_EQ(find_flaw(*model), "") << what;
    const Bytes again = encode(*model);
    EXPECT_EQ(encode(*decode(again)), again) << what;
    return FormatStatus::ok;
}

TEST(Damage, NoPrefixPasses) {
    for (const Bytes& file : small_files()) {
        ASSERT_TRUE(decode(file));
        for (std::size_t n = 0; n < file.size(); ++n) {
            const Bytes prefix(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(n));
            EXPECT_EQ(decode(prefix).status(), n == 0 ? FormatStatus::not_a_pfg : FormatStatus::truncated)
                << n;
        }
    }
}

TEST(Damage, NoFlippedBitPasses) {
    for (const Bytes& file : small_files()) {
        for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
            EXPECT_NE(decode(flipped(file, bit)).status(), FormatStatus::ok) << "bit " << bit;
        }
    }
}

TEST(Damage, NoBurstPasses) {
    Random random(5);
    const auto files = small_files();
    for (int i = 0; i < 10000; ++i) {
        const Bytes& file = files[random.below(files.size())];
        Bytes damaged = file;
        const std::size_t begin = random.below(file.size()), n = 1 + random.below(16);
        for (std::size_t k = begin; k < std::min(begin + n, file.size()); ++k) {
            damaged[k] = static_cast<std::uint8_t>(random.next());
        }
        if (damaged != file) {
            EXPECT_NE(decode(damaged).status(), FormatStatus::ok) << i;
        }
    }
}

TEST(Damage, FlippedBitsUnderARightChecksumAreHarmless) {
    for (const Bytes& file : small_files()) {
        for (std::size_t bit = 0; bit < (file.size() - 4) * 8; ++bit) {
            expect_harmless(resealed(flipped(file, bit)), "bit " + std::to_string(bit));
        }
    }
}

TEST(Damage, PrefixesOfTheStreamUnderARightChecksumAreHarmless) {
    for (const Bytes& file : small_files()) {
        const Bytes stream(file.begin() + 6, file.end() - 4);
        for (std::size_t n = 0; n < stream.size(); ++n) {
            const Bytes part(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
            expect_harmless(seal_envelope(part, {}, file[4]), "prefix " + std::to_string(n));
        }
    }
}

TEST(Damage, RandomStreamsAreHarmless) {
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        Bytes stream(random.below(100));
        for (auto& b : stream) b = static_cast<std::uint8_t>(random.next());
        const auto version = static_cast<std::uint8_t>(1 + i % 3);
        expect_harmless(seal_envelope(stream, {}, version), "stream " + std::to_string(i));
    }
}

// A bound that is known and zero has a shorter code.
TEST(Damage, AZeroBoundOfTheFunctionsIsABadHeader) {
    const auto status = [](std::uint32_t exponent) {
        CodecStream stream;
        EntropyCoder& coder = stream.coder;
        coder.code_raw(1, 1), coder.code_raw(0, 1);     // certified, maximum
        coder.code_raw(0, 16), coder.code_raw(129, 8);  // diagonal: 2
        coder.code_raw(0, 2);                           // no tolerance
        coder.code_raw(0, 6), coder.code_raw(0, 6);     // bound_mesh, rms: 0
        coder.code_raw(1, 1), coder.code_raw(1, 1);     // bound_functions is known and certified
        coder.code_raw(exponent, 6);
        if (exponent > 0) coder.code_raw(0, 5);
        const Bytes bytes = stream.coder.finish();
        CodecStream reader(bytes);
        double diagonal = 0;
        Promise promise;
        code_promise(reader, diagonal, promise);
        return reader.status;
    };
    EXPECT_EQ(status(20), FormatStatus::ok);
    EXPECT_EQ(status(0), FormatStatus::bad_header);
}

// A stream that begins as `begin` writes it and goes on with `tail`.
Bytes bomb(const std::function<void(CodecStream&, Model&)>& begin, std::size_t tail_bytes, int tail) {
    CodecStream stream;
    Model model = ball();
    code_promise(stream, model.diagonal, model.promise);
    begin(stream, model);
    Bytes bytes = stream.coder.finish();
    bytes.insert(bytes.end(), tail_bytes, static_cast<std::uint8_t>(tail));
    return seal_envelope(bytes, {});
}

void claim(CodecStream& stream, std::uint32_t count, std::uint32_t context) {
    stream.mixer.code_uint(stream.coder, count, kCountKind, context);
}

struct Bomb {
    std::string name;
    std::function<void(CodecStream&, Model&)> begin;
};

// Each claims `n` of something.
std::vector<Bomb> bombs(std::uint32_t n) {
    const auto one_object = [](CodecStream& s, std::uint32_t functions) {
        claim(s, functions, 0);
        claim(s, 1, 1);
    };
    return {{"functions", [n](CodecStream& s, Model&) { claim(s, n, 0); }},
            {"objects", [n](CodecStream& s, Model&) { claim(s, 0, 0), claim(s, n, 1); }},
            {"perturbations",
             [=](CodecStream& s, Model& m) {
                 one_object(s, 1);
                 code_flag(s, false, kHasLevelsFlag);
                 code_numbers(s, m.functions[0].base.c, 0);
                 claim(s, n, 2);
             }},
            {"nodes",
             [=](CodecStream& s, Model& m) {
                 one_object(s, 0);
                 s.mixer.code_int(s.coder, 0, kFrameScaleKind);
                 for (int axis = 0; axis < 3; ++axis) code_wide(s, 0, 256);
                 s.mixer.code_uint(s.coder, 0, kShapeKind);
                 claim(s, n, 3);
                 m.objects.clear();
             }},
            {"faces", [=](CodecStream& s, Model&) {
                 one_object(s, 0);
                 s.mixer.code_int(s.coder, 0, kFrameScaleKind);
                 for (int axis = 0; axis < 3; ++axis) code_wide(s, 0, 256);
                 s.mixer.code_uint(s.coder, 2, kShapeKind);
                 s.mixer.code_int(s.coder, -40, 140);
                 s.mixer.code_uint(s.coder, n, 142);
             }}};
}

TEST(Bombs, CountsBeyondTheBytesAreRefusedAtOnce) {
    int refused = 0;
    for (const std::uint32_t n : {100'000U, 1U << 20, 1U << 24, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
        for (const Bomb& b : bombs(n)) {
            for (const int tail : {0, 0x55, 0xAA, 0xFF}) {
                const auto what = b.name + " " + std::to_string(n) + " tail " + std::to_string(tail);
                const Bytes file = bomb(b.begin, tail == 0 ? 0 : 40, tail);
                const FormatStatus status = expect_harmless(file, what, kMostSeconds);
                // A tail may change the last bits of the count, which then says something else.
                if (tail == 0) {
                    EXPECT_EQ(status, FormatStatus::limit_exceeded) << what;
                } else {
                    EXPECT_NE(status, FormatStatus::ok) << what;
                }
                ++refused;
            }
        }
    }
    EXPECT_EQ(refused, 100);
}

// Counts that the memory would allow, and then bits that cost next to nothing.
TEST(Bombs, LongRunsOfCheapBitsAreHarmless) {
    for (const int tail : {0, 1, 0x55, 0xAA, 0xFE, 0xFF}) {
        for (const Bomb& b : bombs(3000)) {
            for (const std::size_t bytes : {0U, 10U, 300U, 1000U}) {
                expect_harmless(bomb(b.begin, bytes, tail), b.name + " tail " + std::to_string(tail));
            }
        }
    }
}

// An object that is everything, then so many placements, then `tail`.
Bytes many_placements(std::uint32_t n, const Bytes& tail) {
    CodecStream stream(2);
    Model model = ball();
    code_promise(stream, model.diagonal, model.promise);
    claim(stream, 0, 0), claim(stream, 1, 1);
    stream.mixer.code_int(stream.coder, 0, kFrameScaleKind);
    for (int axis = 0; axis < 3; ++axis) code_wide(stream, 0, 256);
    stream.mixer.code_uint(stream.coder, 0, kShapeKind);
    claim(stream, 1, 3);
    stream.mixer.code_uint(stream.coder, static_cast<std::uint32_t>(SetNode::Kind::inside), kNodeKind);
    code_flag(stream, false, kCavityFlag);
    claim(stream, 0, 4), claim(stream, n, 5);
    Bytes bytes = stream.coder.finish();
    bytes.insert(bytes.end(), tail.begin(), tail.end());
    return seal_envelope(bytes, {}, 2);
}

TEST(Bombs, PlacementsBeyondTheBytesAreRefusedAtOnce) {
    for (const std::uint32_t n : {100'000U, 1U << 20, 1U << 24, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
        EXPECT_EQ(expect_harmless(many_placements(n, {}), std::to_string(n), kMostSeconds),
                  FormatStatus::limit_exceeded);
    }
    Random random(15);
    for (int i = 0; i < 300; ++i) {
        Bytes tail(random.below(200));
        for (auto& b : tail) b = static_cast<std::uint8_t>(random.next());
        expect_harmless(many_placements(static_cast<std::uint32_t>(random.below(3000)), tail), "tail");
    }
}

// Steps of nothing, turns of nothing, places beyond all bounds: what a writer would never write.
TEST(Damage, WildPlacementsAreRefused) {
    const auto status = [](const std::function<void(Placements&)>& damage) {
        Model model = test::with_placements(ball(), 3);
        Object& object = model.objects[0];
        damage(object.placements);
        CodecStream stream(2);
        code_model(stream, model);  // without the checks of encode
        const Bytes bytes = seal_envelope(stream.coder.finish(), {}, 2);
        return stream.ok() ? expect_harmless(bytes, "wild") : stream.status;
    };
    EXPECT_EQ(status([](Placements&) {}), FormatStatus::ok);
    const std::vector<std::function<void(Placements&)>> wild{
        [](Placements& p) { p.turn_steps = 0; },
        [](Placements& p) { p.turn_steps = (1 << 20) + 1; },
        [](Placements& p) { p.scale_steps = 0; },
        [](Placements& p) { p.step_code = 961; },
        [](Placements& p) { p.step_code = -961; },
        [](Placements& p) { p.step_code = 1 << 21; },
        [](Placements& p) { p.origin[1] = (std::int64_t{1} << 45) + 1; },
        [](Placements& p) { p.origin[2] = std::int64_t{1} << 62; },
        [](Placements& p) { p.list.back().scale = 0; },
        [](Placements& p) { p.list.back().scale = -1; },
        [](Placements& p) { p.list.back().scale = (1 << 26) + 1; },
        [](Placements& p) { p.list.back().place[0] = INT32_MAX; },
        [](Placements& p) { p.list.back().place[1] = (1 << 30) + 1; },
        [](Placements& p) {
            for (Placement& one : p.list) one.place[2] += 1;  // no longer the least origin
        },
        [](Placements& p) {
            p.turn_steps *= 2;
            for (Placement& one : p.list) {
                for (auto& component : one.turn) component *= 2;
            }
        },
        [](Placements& p) { p.list.clear(); }};
    for (std::size_t i = 0; i < wild.size(); ++i) EXPECT_NE(status(wild[i]), FormatStatus::ok) << i;
}

TEST(Bombs, ManyMeshPartsShareOneAccount) {
    Model model = with_mesh_part();
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        model.objects.push_back(model.objects[0]);
        model.objects.back().shape = test::random_mesh_part(random);
    }
    EXPECT_EQ(expect_harmless(encode(model), "300 mesh parts"), FormatStatus::ok);
}

TEST(Bombs, HierarchiesStayWithinTheirAccount) {
    for (const int last_level : {4, 5, 6}) {
        EXPECT_EQ(expect_harmless(encode(with_hierarchy(last_level)), "hierarchy"), FormatStatus::ok);
    }
}

Bytes with_section(SectionId id, const Bytes& content) {
    const Bytes file = encode(ball());
    const Bytes stream(file.begin() + 6, file.end() - 4);
    return seal_envelope(stream, std::vector<Section>{{id, false, content}});
}

Bytes run(std::uint64_t label, std::uint64_t more) {
    ByteWriter out;
    out.varint(label);
    out.varint(more);
    return out.take();
}

TEST(Bombs, RunsOfFaceGroupsAreBounded) {
    EXPECT_EQ(expect_harmless(with_section(SectionId::face_groups, run(1, 1000)), "1,000 faces"),
              FormatStatus::ok);
    for (const std::uint64_t more :
         {std::uint64_t{1} << 28, std::uint64_t{1} << 40, (std::uint64_t{1} << 63) - 1}) {
        EXPECT_EQ(expect_harmless(with_section(SectionId::face_groups, run(1, more)), "run"),
                  FormatStatus::limit_exceeded);
    }
    EXPECT_EQ(expect_harmless(with_section(SectionId::face_groups, run(1U << 31, 1)), "label"),
              FormatStatus::bad_value);
    Bytes twice = run(1, 1);
    twice.insert(twice.end(), {1, 1});
    EXPECT_EQ(expect_harmless(with_section(SectionId::face_groups, twice), "one run as two"),
              FormatStatus::bad_value);
}

TEST(Bombs, BadNamesAndTransformsAreRefused) {
    EXPECT_EQ(expect_harmless(with_section(SectionId::names, {9, 'a'}), "beyond the end"),
              FormatStatus::bad_section);
    EXPECT_EQ(expect_harmless(with_section(SectionId::names, {2, 0xC0, 0x80}), "overlong"),
              FormatStatus::bad_value);
    EXPECT_EQ(expect_harmless(with_section(SectionId::names, {1, 'a', 1, 'b'}), "too many"),
              FormatStatus::bad_value);
    EXPECT_EQ(expect_harmless(with_section(SectionId::names, Bytes(5000, 0)), "5,000"),
              FormatStatus::bad_value);
    EXPECT_EQ(expect_harmless(with_section(SectionId::world_transform, Bytes(95, 0)), "size"),
              FormatStatus::bad_section);
    EXPECT_EQ(expect_harmless(with_section(SectionId::world_transform, Bytes(96, 0xFF)), "nan"),
              FormatStatus::bad_value);
    EXPECT_EQ(expect_harmless(with_section(SectionId::world_transform, Bytes(96, 0x80)), "-tiny"),
              FormatStatus::ok);
}

// Every allocation in turn fails: decode says so and leaks nothing.
TEST(Bombs, FailingAllocationsAreAStatus) {
    for (const Bytes& file : small_files()) {
        FormatStatus status = FormatStatus::limit_exceeded;
        for (int n = 0; status != FormatStatus::ok && n < 100000; ++n) {
            const test::PeakMemory memory;
            {
                const test::FailingAllocation failing(n);
                status = decode(file).status();
            }
            EXPECT_TRUE(status == FormatStatus::ok || status == FormatStatus::limit_exceeded) << name(status);
            EXPECT_EQ(memory.live(), 0) << "after allocation " << n;
        }
        EXPECT_EQ(status, FormatStatus::ok);
    }
}

}  // namespace
}  // namespace pfgeom
