#include "pfgeom/render/scene.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/render/ray_mesh.h"
#include "pfgeom/render/ray_solid.h"
#include "pfgeom/render/ray_tree.h"

#include <algorithm>

namespace pfgeom {
namespace {

std::unique_ptr<RayTarget> make_target(const Model& model, const Object& object, double diagonal,
                                       const Task& task) {
    if (const auto* tree = std::get_if<SetTree>(&object.shape))
        return std::make_unique<RayTree>(*tree, object.frame, task);
    if (const auto* solid = std::get_if<Solid>(&object.shape))
        return std::make_unique<RaySolid>(model, *solid, object.frame, task);
    if (const auto* sheet = std::get_if<Sheet>(&object.shape))
        return std::make_unique<RaySolid>(model, *sheet, object.frame, task);
    return std::make_unique<RayMesh>(object, diagonal, task);
}

// Larger by what rounding may have taken off.
Box with_margin(const Box& box) {
    const Vec3 size = max(max(box.lo, -box.lo), max(box.hi, -box.hi));
    const double by = 1e-12 * (std::max({size.x, size.y, size.z}) + box.diagonal());
    return {box.lo - Vec3{by, by, by}, box.hi + Vec3{by, by, by}};
}

}  // namespace

RayScene::RayScene(const Model& model, const Task& task) : targets_(model.objects.size()) {
    std::vector<Box> boxes;
    const std::vector<CombinationNode> tree = combination_tree(model);
    if (!tree.back().is_operand()) combined_.emplace(model, tree);
    for (std::size_t i = 0; i < tree.size(); ++i) {
        if (!tree[i].is_operand()) continue;
        add(model, tree[i], boxes, task);
        if (combined_) combined_->set_operand(i, pieces_);
    }
    boxes_ = BoxTree(boxes);
}

RayScene::RayScene(const TriangleMesh& mesh, const Task& task) {
    std::vector<Box> boxes;
    targets_.push_back(std::make_unique<RayMesh>(mesh, task));
    Box box;
    for (const Box& part : targets_.back()->cover()) box.grow(part);
    if (!box.empty())
        add_piece({.target = targets_.back().get(), .object = 0, .whole = Similarity{}}, box, boxes);
    boxes_ = BoxTree(boxes);
}

// What an operand before this one has made ready is there already.
void RayScene::add(const Model& model, const CombinationNode& operand, std::vector<Box>& boxes,
                   const Task& task) {
    for (std::int32_t i = operand.first; i < operand.last; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const Object& object = model.objects[row];
        task.report(static_cast<double>(i) / static_cast<double>(model.objects.size()), "preparing");
        if (!targets_[row]) targets_[row] = make_target(model, object, operand.diagonal, task);
        Box box;
        for (const Box& part : targets_[row]->cover()) box.grow(part);
        if (box.empty()) continue;
        RayPiece piece{.target = targets_[row].get(), .object = i};
        piece.is_cavity = object.cavity_of >= 0 && !std::holds_alternative<MeshPart>(object.shape);
        piece.is_moved = operand.moved;
        if (operand.moved) {
            piece.moved = operand.place;
            piece.back = inverse_of(operand.place);
        }
        for (const Similarity& place : copies_of(object)) {
            piece.is_copy = !(place == Similarity{});
            piece.place = place;
            piece.whole = operand.moved ? similarity_of(composed(operand.place, affine_of(place))) : place;
            add_piece(piece, box, boxes);
        }
    }
}

void RayScene::add_piece(const RayPiece& piece, const Box& box, std::vector<Box>& boxes) {
    pieces_.push_back(piece);
    boxes.push_back(with_margin(piece.in_world(box)));
}

// Of equal ones the one that comes first: pieces are met in the ray's order.
SurfaceHit RayScene::first_hit(const Ray& ray, const RaySpan& span) const {
    if (combined_) return combined_->first_hit(pieces_, boxes_, ray, span);
    SurfaceHit best;
    RaySpan left = span;
    boxes_.walk(ray, left, [&](std::int32_t piece, RaySpan& part) {
        const SurfaceHit hit = pieces_[static_cast<std::size_t>(piece)].first_hit(ray, part);
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
        const RayPiece& piece = pieces_[static_cast<std::size_t>(row)];
        const Extreme found = piece.nearest(p, within, accuracy, search);
        best.proved = std::min(best.proved, found.proved);
        const double distance = found.cost;
        if (!(distance < best.distance || (distance == best.distance && piece.object < best.object))) return;
        best.point = found.point;
        best.distance = distance;
        best.object = piece.object;
        within = distance;
    });
    best.proved = std::max(std::min(best.proved, best.distance), 0.0);
    return best;
}

bool RayScene::keeps_distances() const {
    return !combined_ &&
           std::none_of(pieces_.begin(), pieces_.end(), [](const RayPiece& p) { return !p.whole; });
}

Box RayScene::bounds(double accuracy, const Task& task) const {
    Box all;
    if (combined_) {
        for (const Box& box : cover()) all.grow(box);
        return all;
    }
    std::vector<Box> boxes(pieces_.size());
    parallel_chunks(pieces_.size(), 1, task, [&](std::size_t row, std::size_t) {
        ExtremeSearch search(task);
        Vec3 lo, hi;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 direction;
                direction[axis] = sign;
                const std::optional<double> most = pieces_[row].most_along(direction, accuracy, search);
                if (!most) return;
                (sign < 0 ? lo : hi)[axis] = sign * *most;
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
    if (combined_) return combined_->cover(pieces_);
    std::vector<Box> all;
    for (const RayPiece& piece : pieces_) {
        const std::vector<Box> boxes = piece.cover();
        all.insert(all.end(), boxes.begin(), boxes.end());
    }
    return all;
}

}  // namespace pfgeom
