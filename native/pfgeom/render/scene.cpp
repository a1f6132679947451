#include "pfgeom/render/scene.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/render/ray_mesh.h"
#include "pfgeom/render/ray_solid.h"
#include "pfgeom/render/ray_tree.h"

namespace pfgeom {
namespace {

std::unique_ptr<RayTarget> make_target(const Model& model, const Object& object, const Task& task) {
    if (const auto* tree = std::get_if<SetTree>(&object.shape))
        return std::make_unique<RayTree>(*tree, object.frame, task);
    if (const auto* solid = std::get_if<Solid>(&object.shape))
        return std::make_unique<RaySolid>(model, *solid, object.frame, task);
    if (const auto* sheet = std::get_if<Sheet>(&object.shape))
        return std::make_unique<RaySolid>(model, *sheet, object.frame, task);
    return std::make_unique<RayMesh>(model, object, task);
}

Box placed(const Box& box, const Similarity& place) {
    Box all;
    for (unsigned corner = 0; corner < 8; ++corner) {
        all.grow(
            place.apply({(corner & 1U) != 0 ? box.hi.x : box.lo.x, (corner & 2U) != 0 ? box.hi.y : box.lo.y,
                         (corner & 4U) != 0 ? box.hi.z : box.lo.z}));
    }
    return all;
}

// Larger by what rounding may have taken off.
Box with_margin(const Box& box) {
    const Vec3 size = max(max(box.lo, -box.lo), max(box.hi, -box.hi));
    const double by = 1e-12 * (std::max({size.x, size.y, size.z}) + box.diagonal());
    return {box.lo - Vec3{by, by, by}, box.hi + Vec3{by, by, by}};
}

}  // namespace

RayScene::RayScene(const Model& model, const Task& task) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        const Object& object = model.objects[i];
        task.report(static_cast<double>(i) / static_cast<double>(model.objects.size()), "preparing");
        const bool is_cavity = object.cavity_of >= 0 && !std::holds_alternative<MeshPart>(object.shape);
        add(make_target(model, object, task), copies_of(object), is_cavity, boxes);
    }
    boxes_ = BoxTree(boxes);
}

RayScene::RayScene(const TriangleMesh& mesh, const Task& task) {
    std::vector<Box> boxes;
    add(std::make_unique<RayMesh>(mesh, task), std::vector<Similarity>(1), false, boxes);
    boxes_ = BoxTree(boxes);
}

void RayScene::add(std::unique_ptr<RayTarget> target, std::span<const Similarity> places, bool is_cavity,
                   std::vector<Box>& boxes) {
    const auto object = static_cast<std::int32_t>(targets_.size());
    targets_.push_back(std::move(target));
    Box box;
    for (const Box& part : targets_.back()->cover()) box.grow(part);
    if (box.empty()) return;
    for (const Similarity& place : places) {
        const bool moved = !(place == Similarity{});
        pieces_.push_back({targets_.back().get(), object, moved, is_cavity, place});
        boxes.push_back(with_margin(moved ? placed(box, place) : box));
    }
}

// Of equal ones the one that comes first: pieces are met in the ray's order.
SurfaceHit RayScene::first_hit(const Ray& ray, const RaySpan& span) const {
    SurfaceHit best;
    RaySpan left = span;
    boxes_.walk(ray, left, [&](std::int32_t piece, RaySpan& part) {
        const SurfaceHit hit = hit_of(pieces_[static_cast<std::size_t>(piece)], ray, part);
        if (!(hit.t < best.t || (hit.t == best.t && hit.object < best.object))) return;
        best = hit;
        part.to = hit.t;
    });
    return best;
}

NearestPoint RayScene::nearest(const Vec3& p, double accuracy, ExtremeSearch& search) const {
    NearestPoint best;
    double within = std::numeric_limits<double>::infinity();
    boxes_.walk_near(p, within, [&](std::int32_t row) {
        const Piece& piece = pieces_[static_cast<std::size_t>(row)];
        const double scale = piece.is_copy ? piece.place.scale : 1;
        const SearchGoal goal{piece.is_copy ? piece.place.apply_inverse(p) : p, false};
        const Extreme found = piece.target->extreme(goal, within / scale, accuracy / scale, search);
        best.proved = std::min(best.proved, found.proved * scale);
        const double distance = found.cost * scale;
        if (!(distance < best.distance || (distance == best.distance && piece.object < best.object))) return;
        best.point = piece.is_copy ? piece.place.apply(found.point) : found.point;
        best.distance = distance;
        best.object = piece.object;
        within = distance;
    });
    best.proved = std::max(std::min(best.proved, best.distance), 0.0);
    return best;
}

Box RayScene::bounds(double accuracy, const Task& task) const {
    Box all;
    std::vector<Box> boxes(pieces_.size());
    parallel_chunks(pieces_.size(), 1, task, [&](std::size_t row, std::size_t) {
        const Piece& piece = pieces_[row];
        ExtremeSearch search(task);
        Vec3 lo, hi;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 direction;
                direction[axis] = sign;
                const SearchGoal goal{piece.is_copy ? piece.place.turn_back(direction) : direction, true};
                const double scale = piece.is_copy ? piece.place.scale : 1;
                const Extreme found = piece.target->extreme(goal, std::numeric_limits<double>::infinity(),
                                                            accuracy / scale, search);
                if (!found.found()) return;
                const double shift = piece.is_copy ? piece.place.translation[axis] : 0;
                (sign < 0 ? lo : hi)[axis] = shift - sign * found.proved * scale;
            }
        }
        boxes[row] = {lo, hi};
    });
    for (const Box& box : boxes) {
        if (!box.empty()) all.grow(box);
    }
    return all;
}

std::vector<Box> RayScene::cover() const {
    std::vector<Box> all;
    for (const Piece& piece : pieces_) {
        for (const Box& box : piece.target->cover())
            all.push_back(piece.is_copy ? placed(box, piece.place) : box);
    }
    return all;
}

SurfaceHit RayScene::hit_of(const Piece& piece, const Ray& ray, const RaySpan& span) {
    SurfaceHit hit;
    if (piece.is_copy) {
        const Similarity& s = piece.place;
        const Ray back{s.apply_inverse(ray.origin), s.turn_back(ray.direction) / s.scale};
        hit = piece.target->first_hit(back, span);
        hit.normal = s.turn(hit.normal);
    } else {
        hit = piece.target->first_hit(ray, span);
    }
    if (piece.is_cavity) hit.normal = -hit.normal;
    if (hit.found()) hit.object = piece.object;
    return hit;
}

}  // namespace pfgeom
