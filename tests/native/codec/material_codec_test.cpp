#include "pfgeom/codec/material_codec.h"

#include "codec/random_model.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/function/check.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(MaterialCodec, EveryMapComesBackAndIsWrittenTheSameAgain) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Model model = test::random_model(seed % 20);
        if (seed % 3 == 0) {
            Random random(seed);
            model.objects.resize(1);
            model.objects[0].cavity_of = -1;
            model.names.clear();
            model.objects[0].shape = test::random_tree(random, 5);
        }
        if (seed % 2 == 0) model = test::with_placements(model, seed);
        const Model painted = test::painted(model, seed);
        ASSERT_EQ(find_flaw(painted), "");
        const Bytes bytes = encode(painted);
        const Result<Model> back = decode(bytes);
        ASSERT_TRUE(back) << seed << ": " << name(back.status());
        EXPECT_EQ(back->materials, painted.materials) << seed;
        EXPECT_EQ(encode(*back), bytes) << seed;
    }
}

TEST(MaterialCodec, WhoHasNoneWritesNone) {
    const Model plain = test::ball();
    Model painted = test::painted(plain, 1);
    painted.materials = {};
    EXPECT_EQ(encode(painted), encode(plain));
}

TEST(MaterialCodec, OneMaterialTakesAlmostNothing) {
    Model model = test::ball();
    model.materials.names = {""};
    model.materials.objects = {{plain_paint(0)}};
    EXPECT_LE(encode(model).size(), encode(test::ball()).size() + 5);  // the section's head is three of them
}

// Any content gives a status, or materials without a flaw that are written as they were read.
TEST(MaterialCodec, HostileContentIsHarmless) {
    Random random(5);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Model model = test::with_placements(test::ball(), seed);
        model.functions.clear();
        model.objects[0].shape = test::random_tree(random, 4);
        const Bytes good = write_materials(test::painted(model, seed));
        for (int damage = 0; damage < 100; ++damage) {
            Bytes bytes = good;
            for (int n = 1 + test::below(random, 4); n > 0; --n) {
                const int at = test::below(random, static_cast<int>(bytes.size()));
                bytes[static_cast<std::size_t>(at)] ^=
                    static_cast<std::uint8_t>(1 + test::below(random, 255));
            }
            if (damage % 4 == 0) bytes.resize(static_cast<std::size_t>(1 + test::below(random, 40)));
            Model read = model;
            if (read_materials(bytes, std::size_t{1} << 20, read) != FormatStatus::ok) continue;
            ASSERT_EQ(find_flaw_of_materials(read), "");
            EXPECT_EQ(write_materials(read), bytes);
        }
    }
}

TEST(MaterialCodec, MemoryIsBounded) {
    Model model = test::ball();
    const Bytes bytes = write_materials(test::painted(model, 3));
    Model read = model;
    EXPECT_EQ(read_materials(bytes, 40, read), FormatStatus::limit_exceeded);
}

}  // namespace
}  // namespace pfgeom
