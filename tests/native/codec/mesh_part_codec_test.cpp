#include "pfgeom/codec/mesh_part_codec.h"

#include "pfgeom/base/random.h"
#include "pfgeom/function/edges_of_faces.h"
#include "pfgeom/mesh/halves.h"
#include "random_model.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

MeshPart part_of(const TriangleMesh& mesh, int step_code) {
    MeshPart part;
    part.step_code = step_code;
    for (const Vec3& v : mesh.vertices) {
        const Vec3 p = v / part.step();
        part.positions.push_back({static_cast<std::int32_t>(std::floor(p.x + 0.5)),
                                  static_cast<std::int32_t>(std::floor(p.y + 0.5)),
                                  static_cast<std::int32_t>(std::floor(p.z + 0.5))});
    }
    part.faces = mesh.faces;
    return part;
}

std::vector<std::uint8_t> encoded(MeshPart part) {
    EntropyCoder coder;
    ContextMixer mixer;
    EXPECT_EQ(code_mesh_part(coder, mixer, part, part.curved(), 1U << 30), FormatStatus::ok);
    return coder.finish();
}

struct Decoded {
    FormatStatus status = FormatStatus::ok;
    bool clean = false;
    MeshPart part;
};

Decoded decoded(std::span<const std::uint8_t> bytes, bool curved = false,
                const std::optional<MirrorPlane>& mirror = {}) {
    Decoded result;
    result.part.mirror = mirror;
    EntropyCoder coder(bytes);
    ContextMixer mixer;
    result.status = code_mesh_part(coder, mixer, result.part, curved, bytes.size());
    result.clean = coder.ended_cleanly();
    return result;
}

bool equal(const MeshPart& a, const MeshPart& b) {
    return a.step_code == b.step_code && a.positions == b.positions && a.faces == b.faces &&
           a.bulge_code == b.bulge_code && a.bulges == b.bulges && a.mirror == b.mirror;
}

// What bulges on which edge, as points.
std::vector<std::array<std::array<std::int32_t, 3>, 3>> bulges_at(const MeshPart& part) {
    std::vector<std::array<std::array<std::int32_t, 3>, 3>> result;
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    for (std::size_t i = 0; i < edges.ends.size(); ++i) {
        const auto a = part.positions[static_cast<std::size_t>(edges.ends[i][0])];
        const auto b = part.positions[static_cast<std::size_t>(edges.ends[i][1])];
        result.push_back(
            {std::min(a, b), std::max(a, b), {part.bulges[i].normal, part.bulges[i].sideways, 0}});
    }
    std::sort(result.begin(), result.end());
    return result;
}

// The faces as points, each turned to its least rotation: the surface without its numbering.
std::vector<std::array<std::array<std::int32_t, 3>, 3>> surface(const MeshPart& part) {
    std::vector<std::array<std::array<std::int32_t, 3>, 3>> faces;
    for (const Triangle& t : part.faces) {
        std::array<std::array<std::int32_t, 3>, 3> face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = part.positions[static_cast<std::size_t>(t[k])];
        auto least = face;
        for (int turn = 0; turn < 2; ++turn) {
            std::rotate(face.begin(), face.begin() + 1, face.end());
            least = std::min(least, face);
        }
        faces.push_back(least);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

void expect_one_round_trip(const MeshPart& part) {
    const MeshPart ordered = canonical(part);
    EXPECT_EQ(surface(ordered), surface(part));
    EXPECT_TRUE(equal(canonical(ordered), ordered));
    const std::vector<std::uint8_t> bytes = encoded(ordered);
    const Decoded result = decoded(bytes, ordered.curved(), ordered.mirror);
    if (ordered.curved()) {
        EXPECT_EQ(bulges_at(ordered), bulges_at(part));
    }
    EXPECT_EQ(result.status, FormatStatus::ok);
    EXPECT_TRUE(result.clean);
    EXPECT_TRUE(equal(result.part, ordered));
}

// Flat, and with bulges.
void expect_round_trip(const MeshPart& part) {
    expect_one_round_trip(part);
    if (part.faces.empty()) return;
    Random random(part.faces.size());
    expect_one_round_trip(test::with_random_bulges(part, random));
}

TriangleMesh random_soup(Random& random, std::size_t vertices, std::size_t faces) {
    TriangleMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) {
        mesh.vertices.push_back({random.uniform(), random.uniform(), random.uniform()});
    }
    while (mesh.faces.size() < faces) {
        const auto pick = [&] { return static_cast<std::int32_t>(random.below(vertices)); };
        const Triangle t{pick(), pick(), pick()};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.faces.push_back(t);
    }
    return mesh;
}

TEST(MeshPartCodec, RoundTripOfNamedShapes) {
    const std::vector<TriangleMesh> meshes{{},
                                           shapes::cube(),
                                           shapes::sphere(3),
                                           shapes::torus(),
                                           shapes::open_cone(),
                                           shapes::saddle(),
                                           shapes::moebius(),
                                           shapes::klein_bottle(),
                                           shapes::misoriented_sphere(),
                                           shapes::edge_fan(40),
                                           shapes::cubes_sharing_vertex(),
                                           shapes::cubes_sharing_edge(),
                                           shapes::sliver_fan(),
                                           shapes::cracked_cube(),
                                           shapes::soup(shapes::sphere(2)),
                                           shapes::scene_of_islands(20),
                                           shapes::joined(shapes::cube(), shapes::cube())};
    for (const TriangleMesh& mesh : meshes) {
        for (const int step_code : {0, -30, -100}) {
            SCOPED_TRACE(testing::Message() << mesh.faces.size() << " faces, step " << step_code);
            expect_round_trip(part_of(mesh, step_code));
        }
    }
}

TEST(MeshPartCodec, RoundTripOfRandomSoups) {
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        const std::size_t vertices = 3 + random.below(40), faces = random.below(120);
        SCOPED_TRACE(i);
        expect_round_trip(
            part_of(random_soup(random, vertices, faces), -8 * static_cast<int>(random.below(20))));
    }
}

// Their faces meet the plane in any way, along edges with many faces too.
TEST(MeshPartCodec, RoundTripOfMirroredSoups) {
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const MeshPart soup = part_of(random_soup(random, 3 + random.below(40), 1 + random.below(120)), -40);
        expect_round_trip(test::with_mirror(soup, random));
    }
}

// Along the cut nothing says that the surface ends there, and a vertex on it has two coordinates.
TEST(MeshPartCodec, TheCutOfAMirroredPartCostsLittle) {
    MeshPart whole = part_of(half_above(shapes::bumpy_sphere(4), {0, 0}, 0), -8 * 9), half = whole;
    half.mirror = MirrorPlane{};
    const std::size_t open = encoded(canonical(whole)).size(), mirrored = encoded(canonical(half)).size();
    EXPECT_LT(mirrored, open);
    Random random(4);
    expect_round_trip(half);
}

TEST(MeshPartCodec, RoundTripOfExtremeCoordinates) {
    MeshPart part = part_of(shapes::sphere(1), 0);
    Random random(3);
    for (auto& p : part.positions) {
        for (auto& x : p) x = static_cast<std::int32_t>(random.below((1U << 28) - 1)) - ((1 << 27) - 1);
    }
    expect_round_trip(part);
}

TEST(MeshPartCodec, DropsUnusedVertices) {
    MeshPart part = part_of(shapes::cube(), -20);
    part.positions.push_back({1, 2, 3});
    EXPECT_EQ(canonical(part).positions.size(), 8U);
}

TEST(MeshPartCodec, ConnectivityOfAFineSphereCostsLessThanTwoBitsAVertex) {
    const MeshPart fine = canonical(part_of(shapes::sphere(5), -8 * 12));
    EXPECT_LT(encoded(fine).size() * 8, fine.positions.size() * 16);
}

TEST(MeshPartCodec, FlatRegularGridStaysWithinWhatADecoderAccepts) {
    expect_round_trip(part_of(shapes::saddle(150, 0), -8 * 10));
}

TEST(MeshPartCodec, RefusesCountsThatTheBytesCannotHold) {
    const std::vector<std::uint8_t> bytes = encoded(canonical(part_of(shapes::sphere(5), 0)));
    EXPECT_EQ(decoded(std::span(bytes).first(20)).status, FormatStatus::limit_exceeded);
}

TEST(MeshPartCodec, TruncatedStreamsNeverPassForTheWhole) {
    Random random(17);
    const MeshPart flat = canonical(part_of(shapes::sphere(2), -30));
    for (const MeshPart& part : {flat, test::with_random_bulges(flat, random)}) {
        const std::vector<std::uint8_t> bytes = encoded(part);
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            const Decoded result = decoded(std::span(bytes).first(n), part.curved());
            EXPECT_FALSE(result.status == FormatStatus::ok && result.clean && equal(result.part, part)) << n;
        }
    }
}

TEST(MeshPartCodec, BulgesOfASphereAreForeseen) {
    // Each edge bulges as an arc of the sphere does.
    MeshPart part = canonical(part_of(shapes::sphere(3), -8 * 10));
    part.bulge_code = part.step_code;
    for (const auto& [a, b] : EdgesOfFaces::of(part.faces).ends) {
        const auto at = [&](std::int32_t v) {
            const auto& p = part.positions[static_cast<std::size_t>(v)];
            return Vec3{1.0 * p[0], 1.0 * p[1], 1.0 * p[2]};
        };
        const double height = 1 / part.step() - norm((at(a) + at(b)) * 0.5);
        part.bulges.push_back({static_cast<std::int32_t>(std::floor(height + 0.5)), 0});
    }
    MeshPart flat = part;
    flat.bulges.clear();
    const std::size_t more = encoded(part).size() - encoded(flat).size();
    EXPECT_LT(more * 8, part.bulges.size() * 2);
}

void expect_valid_when_damaged(const MeshPart& part) {
    const std::vector<std::uint8_t> bytes = encoded(part);
    const bool curved = part.curved();
    Random random(5);
    for (std::size_t bit = 0; bit < bytes.size() * 8; bit += 1 + random.below(7)) {
        std::vector<std::uint8_t> damaged = bytes;
        damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1U << (bit % 8)));
        const Decoded result = decoded(damaged, curved);
        const auto vertices = static_cast<std::int32_t>(result.part.positions.size());
        for (const Triangle& t : result.part.faces) {
            EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
            for (const std::int32_t v : t) EXPECT_TRUE(v >= 0 && v < vertices);
        }
        if (curved && result.status == FormatStatus::ok) {
            EXPECT_EQ(result.part.bulges.size(), EdgesOfFaces::of(result.part.faces).ends.size());
        }
    }
}

TEST(MeshPartCodec, DamagedStreamsGiveAStatusOrAValidPart) {
    Random random(19);
    const MeshPart part = canonical(part_of(shapes::scene_of_islands(9), -40));
    expect_valid_when_damaged(part);
    expect_valid_when_damaged(test::with_random_bulges(part, random));
}

TEST(MeshPartCodec, RandomBytesGiveAStatusOrAValidPart) {
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        std::vector<std::uint8_t> bytes(random.below(200));
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
        for (const bool curved : {false, true}) {
            const Decoded result = decoded(bytes, curved);
            EXPECT_LE(result.part.faces.size(), 1024 + 32 * bytes.size());
        }
    }
}

}  // namespace
}  // namespace pfgeom
