#include "pfgeom/codec/codec.h"

#include "codec/random_model.h"
#include "pfgeom/base/error.h"
#include "pfgeom/base/random.h"
#include "pfgeom/codec/header.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/codec/model_codec.h"

#include <gtest/gtest.h>

#include <vector>

namespace pfgeom {
namespace {

using test::ball;
using test::random_model;

Model decoded(const std::vector<std::uint8_t>& bytes) {
    Result<Model> model = decode(bytes);
    EXPECT_TRUE(model) << name(model.status());
    return model ? *model : Model{};
}

void expect_equal(const Similarity& a, const Similarity& b) {
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.translation, b.translation);
}

void expect_equal(const Solid& a, const Solid& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        EXPECT_EQ(a.nodes[i].kind, b.nodes[i].kind);
        EXPECT_EQ(a.nodes[i].a, b.nodes[i].a);
        EXPECT_EQ(a.nodes[i].b, b.nodes[i].b);
        EXPECT_EQ(a.nodes[i].f, b.nodes[i].f);
    }
}
void expect_equal(const Sheet& a, const Sheet& b) {
    EXPECT_EQ(a.surface, b.surface);
    EXPECT_EQ(a.trim, b.trim);
    EXPECT_EQ(a.cut, b.cut);
}
void expect_equal(const MeshPart& a, const MeshPart& b) {
    const MeshPart in_order = canonical(a);
    EXPECT_EQ(in_order.step_code, b.step_code);
    EXPECT_EQ(in_order.positions, b.positions);
    EXPECT_EQ(in_order.faces, b.faces);
    EXPECT_EQ(in_order.bulge_code, b.bulge_code);
    EXPECT_EQ(in_order.bulges, b.bulges);
    EXPECT_EQ(in_order.mirror, b.mirror);
}

void expect_equal(const SetTree& a, const SetTree& b) {
    EXPECT_EQ(a, b);
}

void expect_equal(const Object& a, const Object& b) {
    EXPECT_EQ(a.frame, b.frame);
    EXPECT_EQ(a.cavity_of, b.cavity_of);
    EXPECT_EQ(a.mesh_code, b.mesh_code);
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) expect_equal(a.instances[i], b.instances[i]);
    EXPECT_EQ(a.placements, b.placements);
    ASSERT_EQ(a.shape.index(), b.shape.index());
    std::visit(
        [&b](const auto& shape) { expect_equal(shape, std::get<std::decay_t<decltype(shape)>>(b.shape)); },
        a.shape);
}

void expect_equal(const Function& a, const Function& b) {
    EXPECT_EQ(a.base, b.base);
    ASSERT_EQ(a.perturbations.size(), b.perturbations.size());
    for (std::size_t i = 0; i < a.perturbations.size(); ++i) {
        EXPECT_EQ(a.perturbations[i].factor, b.perturbations[i].factor);
        EXPECT_EQ(a.perturbations[i].quadric, b.perturbations[i].quadric);
    }
}

TEST(Codec, RandomModelsComeBackAsTheyWere) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Model model = random_model(seed);
        const Model back = decoded(encode(model));
        ASSERT_EQ(model.functions.size(), back.functions.size());
        for (std::size_t i = 0; i < model.functions.size(); ++i)
            expect_equal(model.functions[i], back.functions[i]);
        ASSERT_EQ(model.objects.size(), back.objects.size());
        for (std::size_t i = 0; i < model.objects.size(); ++i)
            expect_equal(model.objects[i], back.objects[i]);
        EXPECT_EQ(model.names, back.names);
        EXPECT_EQ(model.world_transform, back.world_transform);
        EXPECT_EQ(model.face_groups, back.face_groups);
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

TEST(Codec, WhatWasDecodedEncodesToTheSameBytes) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const std::vector<std::uint8_t> bytes = encode(random_model(seed));
        ASSERT_EQ(encode(decoded(bytes)), bytes) << "seed " << seed;
    }
}

// Its objects come back as they were, in a file of that version.
void expect_round_trip(const Model& model, int version) {
    const std::vector<std::uint8_t> bytes = encode(model);
    EXPECT_EQ(bytes[4], version) << "version";
    const Model back = decoded(bytes);
    ASSERT_EQ(model.objects.size(), back.objects.size());
    for (std::size_t i = 0; i < model.objects.size(); ++i) expect_equal(model.objects[i], back.objects[i]);
    EXPECT_EQ(encode(back), bytes);
}

TEST(Codec, MirroredPartsComeBackAsTheyWere) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Model model = test::with_mirrored_part(random_model(seed), seed);
        if (seed % 3 == 0) model = test::with_placements(std::move(model), seed);
        expect_round_trip(model, 3);
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

TEST(Codec, CutSheetsComeBackAsTheyWere) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Model model = test::with_cut_sheet(random_model(seed), seed);
        expect_round_trip(model, 3);
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

// Older readers know no such shapes, so that a file of an older version has none.
TEST(Codec, MirroredPartsAndCutSheetsAreOfVersionThreeAndNoOther) {
    for (const Model& model :
         {test::with_mirrored_part(test::ball(), 1), test::with_cut_sheet(test::ball(), 1)}) {
        const std::vector<std::uint8_t> bytes = encode(model);
        const Envelope envelope = *open_envelope(bytes, {});
        EXPECT_TRUE(decode(seal_envelope(envelope.stream, {}, 3)));
        for (const int version : {1, 2})
            EXPECT_FALSE(decode(seal_envelope(envelope.stream, {}, static_cast<std::uint8_t>(version))));
    }
    CodecStream stream(3);
    Model plain = test::ball();
    code_model(stream, plain);
    EXPECT_EQ(decode(seal_envelope(stream.coder.finish(), {}, 3)).status(), FormatStatus::bad_header);
}

TEST(Codec, PlacementsComeBackAsTheyWere) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const Model model = test::with_placements(random_model(seed), seed);
        expect_round_trip(model, 2);
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

TEST(Codec, FilesWithoutPlacementsAreOfVersionOne) {
    EXPECT_EQ(encode(ball())[4], 1);
    EXPECT_EQ(encode(random_model(3))[4], 1);
}

// 200 places of a ball: turns of 1 in 256 take 2 + 3 · 9 bits, places in 1 of 4,096 three times 12, less what
// their order saves.
TEST(Codec, APlacementTakesTheBitsOfItsIntegers) {
    Random random(9);
    Model model = ball();
    Placements& p = model.objects[0].placements;
    p.turn_steps = 256;
    p.list.resize(200);
    for (Placement& one : p.list) {
        for (auto& component : one.turn) component = test::below(random, 511) - 255;
        one.turn[static_cast<std::size_t>(test::below(random, 4))] = 256;
        for (auto& at : one.place) at = test::below(random, 4096);
    }
    normalise(p);
    const double each = static_cast<double>(encode(model).size() - encode(ball()).size()) / 200;
    EXPECT_LE(each, (2 + 27 + 36) / 8.0);
    for (Placement& one : p.list) one.turn = p.list[0].turn;
    normalise(p);
    const double unturned = static_cast<double>(encode(model).size() - encode(ball()).size()) / 200;
    EXPECT_LE(unturned, 36 / 8.0) << "a turn that all share costs nothing";
}

TEST(Codec, HierarchiesComeBackWithTheirDerivedGeometry) {
    Random random(21);
    Model model = ball();
    model.functions[0] = test::random_hierarchy(random, 5);
    const Model back = decoded(encode(model));
    ASSERT_EQ(back.functions.size(), 1U);
    const Function &a = model.functions[0], &b = back.functions[0];
    EXPECT_EQ(a.base, b.base);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t i = 0; i < a.levels.size(); ++i) {
        EXPECT_EQ(a.levels[i].z, b.levels[i].z);
        EXPECT_EQ(a.levels[i].thin, b.levels[i].thin);
        EXPECT_EQ(a.levels[i].centres, b.levels[i].centres);
        EXPECT_EQ(a.levels[i].scale, b.levels[i].scale);
        EXPECT_EQ(a.levels[i].lattice, b.levels[i].lattice);
        EXPECT_EQ(a.levels[i].step, b.levels[i].step);
    }
}

TEST(Codec, ADecimalToleranceStaysWhatItIs) {
    for (const double share : {1e-2, 1e-3, 2e-4, 5e-4, 1.25e-3, 3e-7, 0.5}) {
        for (const double diagonal : {2.0, 0.3, 123.4567, 1e9, 7e-8}) {
            Model model = ball();
            model.diagonal = diagonal;
            model.promise = {Metric::max, share * diagonal, share * diagonal / 2, true, 0};
            const Model back = decoded(encode(model));
            EXPECT_NEAR(back.promise.tolerance / back.diagonal, share, 1e-15 * share);
            EXPECT_GE(back.diagonal, diagonal);
            EXPECT_LE(back.diagonal, diagonal * (1 + 1.0 / 65536));
        }
    }
    Model absolute = ball();
    absolute.diagonal = 137.035999;
    absolute.promise.tolerance = 0.05;
    EXPECT_EQ(decoded(encode(absolute)).promise.tolerance, 0.05);
}

// What is rounded is rounded up, but never over the tolerance: a promise that held is not broken by storing
// it.
TEST(Codec, ErrorsAreRoundedUpAndPromisesStayKept) {
    Random random(31);
    for (int i = 0; i < 2000; ++i) {
        Model model = ball();
        model.diagonal = test::between(random, 0.1, 100);
        model.promise = test::random_promise(random, model.diagonal);
        if (i % 10 == 0) model.promise.bound_mesh = model.promise.tolerance;
        if (i % 10 == 1) model.promise.rms = 0;
        if (i % 10 == 2) model.promise.bound_functions = model.promise.tolerance;
        const Promise &a = model.promise, b = decoded(encode(model)).promise;
        EXPECT_EQ(a.metric, b.metric);
        EXPECT_EQ(a.certified, b.certified);
        EXPECT_NEAR(b.tolerance, a.tolerance, 2e-5 * a.tolerance);
        EXPECT_GE(b.tolerance, a.tolerance * (1 - 1e-12));
        EXPECT_LE(b.bound_mesh, b.tolerance * (1 + 1e-12));
        EXPECT_GE(b.bound_mesh, a.bound_mesh * (1 - 1e-12));
        EXPECT_LE(b.bound_mesh, a.bound_mesh * 1.032 + 1e-11 * a.tolerance);
        EXPECT_GE(b.rms, a.rms * (1 - 1e-12));
        EXPECT_LE(b.rms, a.rms * 1.032 + 1e-11 * a.tolerance);
        EXPECT_EQ(a.functions_certified, b.functions_certified);
        EXPECT_EQ(a.bound_functions == 0, b.bound_functions == 0);
        EXPECT_LE(b.bound_functions, b.tolerance * (1 + 1e-12));
        EXPECT_GE(b.bound_functions, a.bound_functions * (1 - 1e-12));
        EXPECT_LE(b.bound_functions, a.bound_functions * 1.032);
        ASSERT_FALSE(HasFailure()) << "model " << i;
    }
}

TEST(Codec, TheBoundOfTheFunctionsTakesTwoBytes) {
    Model model = ball();
    const std::size_t without = encode(model).size();
    for (const bool certified : {false, true}) {
        model.promise.bound_functions = 1.7e-3;
        model.promise.functions_certified = certified;
        EXPECT_GT(encode(model).size(), without);
        EXPECT_LE(encode(model).size(), without + 2);
    }
}

TEST(Codec, AModelWithoutAPromiseIsAModel) {
    Model model = ball();
    model.promise = {};
    const Promise promise = decoded(encode(model)).promise;
    EXPECT_EQ(promise.tolerance, 0);
    EXPECT_EQ(promise.bound_mesh, 0);
    EXPECT_EQ(promise.rms, 0);
    EXPECT_EQ(promise.bound_functions, 0);
    EXPECT_FALSE(promise.functions_certified);
}

TEST(Codec, AllThatIsNotFunctionsTakesAtMost32Bytes) {
    Random random(41);
    for (int i = 0; i < 300; ++i) {
        Model model = ball();
        model.diagonal = test::between(random, 0.01, 1000);
        model.promise = test::random_promise(random, model.diagonal);
        Box box;
        box.grow(Vec3{0, 0, 0});
        box.grow(Vec3{model.diagonal, model.diagonal, model.diagonal} * 0.577);
        for (double* c : {&box.lo.x, &box.lo.y, &box.lo.z}) *c += 3 * model.diagonal * random.uniform();
        box.hi += box.lo;
        model.objects[0].frame = Frame::around(box);
        model.objects[0].mesh_code = static_cast<std::uint8_t>(20 + random.below(40));
        const SizeReport report = measure_size(model);
        EXPECT_LE(report.head, 32U);
        EXPECT_EQ(report.total, encode(model).size());
    }
}

TEST(Codec, SizesAddUp) {
    Random random(42);
    Model model = ball();
    model.functions[0] = test::random_hierarchy(random, 4);
    model.functions.push_back(test::random_function(random));
    model.objects.resize(3, model.objects[0]);
    model.objects[1].shape = test::random_mesh_part(random);
    model.objects[2].shape = Sheet{1, 0, {}};
    model = test::with_cut_sheet(std::move(model), 42);
    const SizeReport report = measure_size(model);
    ASSERT_EQ(report.bytes_of_object.size(), 4U);
    double sum = static_cast<double>(report.head), levels = 0;
    for (const double bytes : report.bytes_of_object) {
        EXPECT_GT(bytes, 0);
        sum += bytes;
    }
    for (const double bytes : report.bytes_of_level) levels += bytes;
    EXPECT_NEAR(sum, static_cast<double>(report.total), 1);
    EXPECT_NEAR(levels, report.bytes_of_object[0], 0.1 * report.bytes_of_object[0] + 3);
}

// Objects share one stream: the thousandth equal one is nearly free.
TEST(Codec, AThousandEqualObjectsCostLittle) {
    Model model = ball();
    const std::size_t one = encode(model).size();
    for (int i = 1; i < 1000; ++i) {
        model.functions.push_back(model.functions[0]);
        model.objects.push_back(model.objects[0]);
        std::get<Solid>(model.objects.back().shape).nodes[0].a = i;
    }
    EXPECT_LT(encode(model).size(), one + 4000);
}

TEST(Codec, NegativeZeroIsZero) {
    Model a = ball(), b = ball();
    b.functions[0].base.c[3] = -0.0;
    EXPECT_EQ(encode(a), encode(b));
}

TEST(Codec, NumbersOfEverySizeComeBack) {
    Model model = ball();
    model.functions[0].base.c = {1e-60, -1e-60, 5e-324, 1e60, -1, 1.0 / 3, 0, 0x1p-1074, 123456789, 1e22};
    EXPECT_EQ(decoded(encode(model)).functions[0].base, model.functions[0].base);
    model.functions[0].base.c = {};
    EXPECT_EQ(decoded(encode(model)).functions[0].base, model.functions[0].base);
}

TEST(Codec, WhatIsNotAModelIsNotEncoded) {
    EXPECT_THROW(encode(Model{}), InvalidInput);
    const auto refuses = [](auto change) {
        Model model = ball();
        change(model);
        EXPECT_THROW(encode(model), InvalidInput);
    };
    refuses([](Model& m) { m.objects.clear(); });
    refuses([](Model& m) { m.promise.bound_mesh = 1e9 * m.promise.tolerance; });
    refuses([](Model& m) { m.promise.bound_functions = 1e9 * m.promise.tolerance; });
    refuses([](Model& m) { m.promise.functions_certified = true; });
    refuses([](Model& m) { m.promise.tolerance = 1e-38 * m.diagonal * 1.000123456789; });
    refuses([](Model& m) { m.functions.clear(); });
}

}  // namespace
}  // namespace pfgeom
