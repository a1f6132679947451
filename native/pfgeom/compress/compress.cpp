#include "pfgeom/compress/compress.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/candidate.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Boundary edges closer than this share of the tolerance are one seam.
constexpr double kSeamShare = 1.0 / 16;
// Up to so many faces the mesh candidate is cheap enough to be made as the bytes to beat.
constexpr std::size_t kQuickMesh = 40'000;
constexpr std::size_t kNoLimit = std::size_t{1} << 24;  // of bytes
// Fewer faces than this are not worth a hierarchy.
constexpr std::size_t kLeastFaces = 100;
// Nor are fewer than this worth a sheet, which takes some 40 bytes.
constexpr std::size_t kLeastFacesOfSheet = 16;
// Every island holds the tolerance on its own; should the whole miss it by what the last measurement sees
// and the earlier ones did not, all is done again within these shares of it.
constexpr double kShares[] = {1.0, 0.95, 0.7};
// From so many islands on they are worked on side by side, one thread each.
constexpr std::size_t kManyIslands = 8;

class Compressor {
  public:
    Compressor(const TriangleMesh& input, const CompressOptions& options, const Task& task)
        : input_(input), options_(options), task_(task) {}

    Compressed run() {
        check_options();
        task_.report(0, "prepare");
        check_mesh(input_);
        const double size = diagonal(input_);
        tolerance_ = options_.tolerance * (options_.relative ? size : 1.0);
        prepared_ = prepare_mesh(input_, kSeamShare * tolerance_);
        task_.report(0.02, "fit");
        for (const double share : kShares) {
            share_ = share;
            fit_islands();
            assemble();
            if (finish()) break;
        }
        if (result_.bytes.empty())
            throw LimitExceeded("the compressed model asks for more work than its size allows");
        task_.report(1, "done");
        return std::move(result_);
    }

  private:
    void check_options() const {
        if (!(options_.tolerance > 0) || !std::isfinite(options_.tolerance)) {
            throw InvalidInput("the tolerance must be a positive number");
        }
    }

    // Where seams were closed, the prepared mesh differs from the input by up to their distance.
    double moved() const { return prepared_.defects.seam_edges > 0 ? kSeamShare * tolerance_ : 0; }

    Goal goal_of(const TriangleMesh& mesh, const Bvh& bvh, bool inward) const {
        const double tolerance = share_ * (tolerance_ - moved());
        return {mesh, bvh, tolerance, options_.metric, prepared_.diagonal, inward, options_.effort};
    }

    void fit_islands() {
        const std::size_t n = prepared_.islands.size();
        chosen_.assign(n, {});
        if (n < kManyIslands) {
            for (std::size_t i = 0; i < n; ++i) {
                const double at = static_cast<double>(i) / static_cast<double>(n);
                const Task part =
                    part_of(task_, 0.02 + 0.8 * at, 0.02 + 0.8 * (at + 1.0 / static_cast<double>(n)));
                part.report(0, "fit");
                chosen_[i] = fit_island(prepared_.islands[i], part);
            }
            return;
        }
        constexpr std::size_t kBatch = 64;
        for (std::size_t from = 0; from < n; from += kBatch) {
            const std::size_t count = std::min(kBatch, n - from);
            parallel_chunks(count, 1, quiet(task_, task_.threads), [&](std::size_t i, std::size_t) {
                chosen_[from + i] = fit_island(prepared_.islands[from + i], quiet(task_, 1));
            });
            task_.report(0.02 + 0.8 * static_cast<double>(from + count) / static_cast<double>(n), "fit");
        }
    }

    // The cheapest candidate that holds; nothing: the island goes into the common mesh part.
    std::optional<Outcome> fit_island(const Island& island, const Task& task) const {
        if (!island.closed && island.manifold && island.oriented) return fit_open_island(island, task);
        if (!island.closed || !island.oriented || island.faces.size() < 8) return {};
        const TriangleMesh mesh = extract_island(prepared_, island);
        const Bvh bvh(mesh);
        const Goal goal = goal_of(mesh, bvh, island.signed_volume < 0);
        if (std::optional<Outcome> quadric = try_quadric(goal, task)) return quadric;
        if (mesh.faces.size() < kLeastFaces) return {};
        return goal.metric == Metric::max ? fit_by_max(goal, task) : fit_by_rms(goal, task);
    }

    // What is no sheet goes into the mesh part with all the others.
    std::optional<Outcome> fit_open_island(const Island& island, const Task& task) const {
        if (island.faces.size() < kLeastFacesOfSheet) return {};
        const TriangleMesh mesh = extract_island(prepared_, island);
        const Bvh bvh(mesh);
        return try_sheet(goal_of(mesh, bvh, false), task);
    }

    // A tree comes first: where a shape is made of quadrics nothing else comes near, and neither needs to be
    // made for comparison. The estimate of the mesh says when that is so.
    std::optional<Outcome> fit_by_max(const Goal& goal, const Task& task) const {
        const MeshEstimate estimate = estimate_mesh(goal, task);
        const bool all = goal.effort == Effort::best, large = goal.mesh.faces.size() > kQuickMesh;
        std::optional<Outcome> best = try_tree(goal, estimate.likely, task);
        if (best && best->bytes < estimate.least && !all) return best;
        Outcome plain = try_mesh(goal, task);
        // Measured on igea and armadillo at a maximum of 1e-3: no hierarchy that holds beats the mesh part.
        // None has beaten a tree.
        if (all || (!best && !large) || !plain.holds) {
            const std::size_t most = std::min(best ? best->bytes : plain.bytes, plain.bytes);
            take_cheaper(try_hierarchy(goal, most, task), best);
        }
        take_cheaper(std::move(plain), best);
        return best;
    }

    std::optional<Outcome> fit_by_rms(const Goal& goal, const Task& task) const {
        const MeshEstimate estimate = estimate_mesh(goal, task);
        std::optional<Outcome> best = try_tree(goal, estimate.likely, task);
        const bool far_below = best && best->bytes < estimate.least && goal.effort != Effort::best;
        if (!far_below && goal.mesh.faces.size() <= kQuickMesh) take_cheaper(try_mesh(goal, task), best);
        // A smooth form's tree can be certified and yet take half as many bytes again as its hierarchy; the
        // search of that starts too fine.
        take_cheaper(try_hierarchy(goal, best ? 2 * best->bytes : kNoLimit, task), best);
        return best;
    }

    static void take_cheaper(std::optional<Outcome> outcome, std::optional<Outcome>& best) {
        if (outcome && outcome->holds && (!best || outcome->bytes < best->bytes)) best = std::move(outcome);
    }

    bool is_function(std::size_t i) const { return chosen_[i] && chosen_[i]->candidate != "mesh"; }

    // Objects in order of nesting (a cavity stands behind what it is taken out of), then one mesh part for
    // the rest.
    void assemble() {
        const std::size_t n = prepared_.islands.size();
        model_ = {};
        model_.diagonal = prepared_.diagonal;
        of_mesh_part_.reset();
        std::vector<std::int32_t> object_of(n, -1);
        std::vector<std::size_t> rest;
        for (const std::size_t i : by_nesting()) {
            if (!is_function(i))
                rest.push_back(i);
            else
                object_of[i] = add_function_object(i, object_of);
        }
        std::sort(rest.begin(), rest.end());
        if (!rest.empty()) add_mesh_part(rest);
    }

    std::vector<std::size_t> by_nesting() const {
        std::vector<std::size_t> depth(prepared_.islands.size(), 0), order(depth.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
            for (std::int32_t p = prepared_.islands[i].parent; p >= 0;
                 p = prepared_.islands[static_cast<std::size_t>(p)].parent) {
                ++depth[i];
            }
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return depth[a] < depth[b]; });
        return order;
    }

    std::int32_t add_function_object(std::size_t i, const std::vector<std::int32_t>& object_of) {
        Object object = chosen_[i]->object;
        const Island& island = prepared_.islands[i];
        const std::int32_t outer =
            island.parent >= 0 ? object_of[static_cast<std::size_t>(island.parent)] : -1;
        const auto offset = static_cast<std::int32_t>(model_.functions.size());
        auto* solid = std::get_if<Solid>(&object.shape);
        auto* tree = std::get_if<SetTree>(&object.shape);
        auto* sheet = std::get_if<Sheet>(&object.shape);
        if (island.closed && island.signed_volume < 0 && outer >= 0) {
            object.cavity_of = outer;  // then the solid is the hollow itself
            if (solid != nullptr) solid->nodes.pop_back();
            if (tree != nullptr) tree->complement = false;
        }
        if (solid != nullptr) {
            for (SetNode& node : solid->nodes) {
                if (node.kind == SetNode::Kind::function) node.a += offset;
            }
        }
        if (sheet != nullptr) sheet->surface += offset, sheet->trim += offset;
        for (Function& f : chosen_[i]->functions) model_.functions.push_back(f);
        model_.objects.push_back(std::move(object));
        return static_cast<std::int32_t>(model_.objects.size()) - 1;
    }

    void add_mesh_part(const std::vector<std::size_t>& rest) {
        if (rest.size() == 1 && chosen_[rest[0]]) {
            model_.objects.push_back(chosen_[rest[0]]->object);
            of_mesh_part_ = chosen_[rest[0]]->deviation;
            return;
        }
        Island together;
        for (const std::size_t i : rest) {
            const auto& faces = prepared_.islands[i].faces;
            together.faces.insert(together.faces.end(), faces.begin(), faces.end());
        }
        std::sort(together.faces.begin(), together.faces.end());
        const TriangleMesh mesh = extract_island(prepared_, together);
        const Bvh bvh(mesh);
        Outcome outcome = try_mesh(goal_of(mesh, bvh, false), part_of(task_, 0.82, 0.95));
        model_.objects.push_back(std::move(outcome.object));
        of_mesh_part_ = outcome.deviation;
    }

    // What is proved of the functions' own surface; a mesh part is its own default mesh. Nothing if an
    // island's function has no proof, or if all is mesh and bound_mesh says it.
    void promise_functions() {
        double worst = 0;
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            if (!is_function(i)) continue;
            if (chosen_[i]->bound_functions == 0) return;
            worst = std::max(worst, chosen_[i]->bound_functions);
        }
        if (worst == 0) return;
        const bool certified = !of_mesh_part_ || of_mesh_part_->certified;
        if (of_mesh_part_) {
            worst = std::max(worst, certified ? of_mesh_part_->max_bound() : of_mesh_part_->max());
        }
        model_.promise.bound_functions = worst + moved();
        model_.promise.functions_certified = certified;
    }

    // The promise is measured on the decoded bytes, against the input as it was given; its figures change a
    // few bytes of the header only. False: the promise is broken.
    bool finish() {
        model_.promise = {options_.metric, tolerance_, tolerance_, false, tolerance_};
        const Result<Model> first = decode(encode(model_));
        if (!first) return false;  // asks for more work than its size allows
        const bool proved = reads_as_proved(*first);
        const TriangleMesh mesh =
            proved ? mesh_of_islands() : to_mesh(*first, {}, quiet(task_, task_.threads));
        task_.report(0.96, "measure");
        DeviationOptions options;
        // Of a maximum, which is proved, samples tell only the rms beside it.
        const bool by_max = options_.metric == Metric::max;
        const std::size_t most = by_max ? 50'000 : options.samples;
        options.samples = std::clamp<std::size_t>(prepared_.mesh.faces.size() * 20, 50'000, most);
        if (by_max) options.certify_below = tolerance_;
        const std::optional<Deviation> maximum = by_max && proved ? maximum_of_islands() : std::nullopt;
        options.bound = !maximum;
        result_.report.deviation = measure_deviation(input_, mesh, options, quiet(task_, task_.threads));
        if (maximum) {
            result_.report.deviation.a_to_b.max_bound = result_.report.deviation.b_to_a.max_bound = 0;
            take_maximum(*maximum, result_.report.deviation);
        }
        const Deviation& d = result_.report.deviation;
        model_.promise.certified = d.certified;
        model_.promise.bound_mesh = d.certified ? d.max_bound() : d.max();
        model_.promise.rms = d.rms();
        promise_functions();
        result_.bytes = encode(model_);
        result_.model = *decode(result_.bytes);
        fill_report(mesh);
        const double reached =
            options_.metric == Metric::rms ? model_.promise.rms : model_.promise.bound_mesh;
        return reached <= tolerance_;
    }

    // Does the file hold the islands' functions, and nothing else, as they were when they were made meshes?
    bool reads_as_proved(const Model& decoded) const {
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            if (!is_function(i)) return false;
        }
        return decoded.functions == model_.functions && decoded.objects == model_.objects;
    }

    TriangleMesh mesh_of_islands() const {
        TriangleMesh mesh;
        for (const std::size_t i : by_nesting()) append(chosen_[i]->mesh, mesh);
        return mesh;
    }

    // What is proved of the islands: no point is farther from all of a surface than from a part of it.
    // Nothing if the input is more than the islands, or was moved.
    std::optional<Deviation> maximum_of_islands() const {
        if (prepared_.defects.degenerate_faces > 0 || prepared_.defects.seam_edges > 0) return {};
        Deviation all;
        all.certified = true;
        for (const std::optional<Outcome>& island : chosen_) {
            if (!island->deviation.certified) return {};
            take_maximum(island->deviation, all);
        }
        return all;
    }

    // Of two certified deviations.
    static void take_maximum(const Deviation& more, Deviation& deviation) {
        for (const auto side : {&Deviation::a_to_b, &Deviation::b_to_a}) {
            OneSided& mine = deviation.*side;
            const OneSided& other = more.*side;
            if (other.max > mine.max) mine.max = other.max, mine.worst = other.worst;
            mine.max_bound = std::max(mine.max_bound, other.max_bound);
        }
        deviation.certified = more.certified;
    }

    void fill_report(const TriangleMesh& mesh) {
        CompressReport& r = result_.report;
        r.islands.clear();
        r.defects = prepared_.defects;
        r.input_vertices = static_cast<std::int64_t>(input_.vertices.size());
        r.input_faces = static_cast<std::int64_t>(input_.faces.size());
        r.raw_bytes = 12 * (r.input_vertices + r.input_faces);
        r.mesh_faces = static_cast<std::int64_t>(mesh.faces.size());
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            IslandReport island;
            island.faces = static_cast<std::int64_t>(prepared_.islands[i].faces.size());
            island.candidate = chosen_[i] ? chosen_[i]->candidate : "mesh";
            island.bytes = chosen_[i] ? static_cast<double>(chosen_[i]->bytes) : 0;
            r.islands.push_back(island);
        }
    }

    const TriangleMesh& input_;
    const CompressOptions& options_;
    const Task& task_;
    double tolerance_ = 0;
    double share_ = 1;  // of the tolerance, that the islands may use
    PreparedMesh prepared_;
    std::vector<std::optional<Outcome>> chosen_;
    std::optional<Deviation> of_mesh_part_;
    Model model_;
    Compressed result_;
};

}  // namespace

Compressed compress(const TriangleMesh& mesh, const CompressOptions& options, const Task& task) {
    return Compressor(mesh, options, task).run();
}

}  // namespace pfgeom
