#include "pfgeom/compress/compress.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/fit_copies.h"
#include "pfgeom/compress/paint_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace pfgeom {
namespace {

// Boundary edges closer than this share of the tolerance are one seam.
constexpr double kSeamShare = 1.0 / 16;
// Islands whose surfaces are so much of the tolerance from being copies are treated as copies.
constexpr double kCopyShare = 0.25;
// Every island holds the tolerance on its own; should the whole miss it by what the last measurement sees
// and the earlier ones did not, all is done again within these shares of it.
constexpr double kShares[] = {1.0, 0.95, 0.7};
// From so many islands on they are worked on side by side, one thread each.
constexpr std::size_t kManyIslands = 8;
// Frames reach to 2^120, and the steps of grids and lengths to 2^-120.
constexpr double kLargest = 1e32;
constexpr double kFitting = 0.8;  // of the progress

class Compressor {
  public:
    Compressor(const TriangleMesh& input, const FaceMaterials& materials, const CompressOptions& options,
               const Task& task)
        : input_(input), materials_(materials), options_(options), task_(task) {}

    Compressed run() {
        check_options();
        task_.report(0, "prepare");
        check_mesh(input_);
        check_materials(materials_, input_.faces.size());
        const double size = diagonal(input_);
        if (!(size >= 1 / kLargest && size <= kLargest))
            throw InvalidInput("the mesh's diagonal is not between 1e-32 and 1e32, which a file can hold");
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
        if (has_materials()) add_materials(part_of(task_, 0.98, 1));
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
        return {mesh,           bvh, tolerance, options_.metric, prepared_.diagonal, inward, options_.effort,
                has_materials()};
    }

    // First those that repeat, then the others one by one.
    void fit_islands() {
        const std::size_t n = prepared_.islands.size();
        chosen_.assign(n, {});
        copies_.assign(n, {});
        first_of_.resize(n);
        std::iota(first_of_.begin(), first_of_.end(), std::size_t{0});
        const bool repeats = fit_repeated(part_of(task_, 0.02, 0.02 + kFitting / 2));
        std::vector<std::size_t> single;
        for (std::size_t i = 0; i < n; ++i) {
            if (!outcome_of(i)) single.push_back(i);
        }
        const double from = repeats ? 0.02 + kFitting / 2 : 0.02;
        fit_single(single, part_of(task_, from, 0.02 + kFitting));
    }

    // Does anything repeat?
    bool fit_repeated(const Task& task) {
        const double tolerance = share_ * (tolerance_ - moved());
        const std::vector<CopyGroup> groups =
            find_copies(prepared_, kCopyShare * tolerance, quiet(task, task.threads));
        const auto count = static_cast<double>(groups.size());
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const Task part =
                part_of(task, static_cast<double>(g) / count, static_cast<double>(g + 1) / count);
            part.report(0, "fit");
            std::optional<FittedCopies> fitted = fit_copies(
                groups[g], {prepared_, tolerance, options_.metric, options_.effort, has_materials()}, part);
            if (!fitted) continue;
            const std::size_t first = *std::min_element(fitted->islands.begin(), fitted->islands.end());
            for (const std::size_t i : fitted->islands) first_of_[i] = first;
            chosen_[first] = std::move(fitted->outcome);
            copies_[first] = std::move(fitted->islands);
        }
        return !groups.empty();
    }

    void fit_single(const std::vector<std::size_t>& islands, const Task& task) {
        const std::size_t n = islands.size();
        const auto done = [n](std::size_t i) { return static_cast<double>(i) / static_cast<double>(n); };
        if (n < kManyIslands) {
            for (std::size_t k = 0; k < n; ++k) {
                const Task part = part_of(task, done(k), done(k + 1));
                part.report(0, "fit");
                chosen_[islands[k]] = fit_alone(prepared_.islands[islands[k]], part);
            }
            return;
        }
        constexpr std::size_t kBatch = 64;
        for (std::size_t from = 0; from < n; from += kBatch) {
            const std::size_t count = std::min(kBatch, n - from);
            parallel_chunks(count, 1, quiet(task, task.threads), [&](std::size_t k, std::size_t) {
                const std::size_t i = islands[from + k];
                chosen_[i] = fit_alone(prepared_.islands[i], quiet(task, 1));
            });
            task.report(done(from + count), "fit");
        }
    }

    // Nothing: the island goes into the common mesh part.
    std::optional<Outcome> fit_alone(const Island& island, const Task& task) const {
        if (!island.oriented) return {};
        const TriangleMesh mesh = extract_island(prepared_, island);
        const Bvh bvh(mesh);
        return fit_island(island, goal_of(mesh, bvh, island.closed && island.signed_volume < 0), task);
    }

    const std::optional<Outcome>& outcome_of(std::size_t i) const { return chosen_[first_of_[i]]; }

    // Is the island one by itself, or one of the copies of one? Else it is in the common mesh part.
    bool is_object(std::size_t i) const {
        const std::optional<Outcome>& outcome = outcome_of(i);
        return outcome && (outcome->candidate != "mesh" || !outcome->object.placements.empty());
    }

    // Objects in order of nesting (a cavity stands behind what it is taken out of), then one mesh part for
    // the rest.
    void assemble() {
        const std::size_t n = prepared_.islands.size();
        model_ = {};
        model_.diagonal = prepared_.diagonal;
        of_mesh_part_.reset();
        objects_.clear();
        islands_of_.clear();
        std::vector<std::int32_t> object_of(n, -1);
        std::vector<std::size_t> rest;
        for (const std::size_t i : by_nesting()) {
            if (!is_object(i)) {
                rest.push_back(i);
                continue;
            }
            std::int32_t& object = object_of[first_of_[i]];
            if (object < 0) object = add_object(first_of_[i], i, object_of);
            object_of[i] = object;
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

    // `i`: the first of its islands in order of nesting; copies are no cavities.
    std::int32_t add_object(std::size_t chosen, std::size_t i, const std::vector<std::int32_t>& object_of) {
        const Outcome& outcome = *chosen_[chosen];
        objects_.push_back(chosen);
        Object object = outcome.object;
        const Island& island = prepared_.islands[i];
        const std::int32_t outer =
            island.parent >= 0 ? object_of[static_cast<std::size_t>(island.parent)] : -1;
        const auto offset = static_cast<std::int32_t>(model_.functions.size());
        auto* solid = std::get_if<Solid>(&object.shape);
        auto* tree = std::get_if<SetTree>(&object.shape);
        auto* sheet = std::get_if<Sheet>(&object.shape);
        if (island.closed && island.signed_volume < 0 && outer >= 0 && object.placements.empty()) {
            object.cavity_of = outer;  // then the solid is the hollow itself
            if (solid != nullptr) solid->nodes.pop_back();
            if (tree != nullptr) tree->complement = false;
        }
        if (solid != nullptr) {
            for (SetNode& node : solid->nodes) {
                if (node.kind == SetNode::Kind::function) node.a += offset;
            }
        }
        if (sheet != nullptr) sheet->surface += offset, sheet->trim += sheet->trim >= 0 ? offset : 0;
        for (const Function& f : outcome.functions) model_.functions.push_back(f);
        model_.objects.push_back(std::move(object));
        islands_of_.emplace_back();
        for (const std::size_t copy : copies_[chosen]) islands_of_.back().push_back({copy});
        if (islands_of_.back().empty()) islands_of_.back().push_back({i});
        return static_cast<std::int32_t>(model_.objects.size()) - 1;
    }

    void add_mesh_part(const std::vector<std::size_t>& rest) {
        islands_of_.push_back({rest});
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
        Outcome outcome = try_mesh(goal_of(mesh, bvh, false), {}, kAnyBytes, part_of(task_, 0.82, 0.95));
        model_.objects.push_back(std::move(outcome.object));
        of_mesh_part_ = outcome.deviation;
    }

    // What is proved of the functions' own surface; a mesh part is its own default mesh. Nothing if an
    // island's function has no proof, or if all is mesh and bound_mesh says it.
    void promise_functions() {
        double worst = 0;
        bool certified = true;
        const auto add_mesh = [&](const Deviation& d) {
            worst = std::max(worst, d.certified ? d.max_bound() : d.max());
            certified = certified && d.certified;
        };
        bool functions = false;
        for (const std::size_t i : objects_) {
            if (chosen_[i]->candidate == "mesh") {
                add_mesh(chosen_[i]->deviation);
                continue;
            }
            if (chosen_[i]->bound_functions == 0) return;
            functions = true;
            worst = std::max(worst, chosen_[i]->bound_functions);
        }
        if (!functions) return;
        if (of_mesh_part_) add_mesh(*of_mesh_part_);
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
            proved ? mesh_of_islands()
                   : to_mesh(*first, {.thin = !has_materials()}, quiet(task_, task_.threads));
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

    // One material without a name says nothing.
    bool has_materials() const {
        return materials_.names.size() > 1 || (materials_.names.size() == 1 && !materials_.names[0].empty());
    }

    // Beside the functions, which stay as they are.
    void add_materials(const Task& task) {
        const PaintGoal goal{input_, materials_, prepared_, islands_of_, tolerance_, options_.effort};
        result_.model.materials = paint_model(result_.model, goal, result_.report.paint, task);
        std::vector<std::uint8_t> bytes = encode(result_.model);
        result_.report.paint.bytes = bytes.size() - result_.bytes.size();
        result_.bytes = std::move(bytes);
        result_.model = *decode(result_.bytes);
    }

    // Does the file hold the islands' functions, and nothing else, as they were when they were made meshes?
    bool reads_as_proved(const Model& decoded) const {
        for (std::size_t i = 0; i < chosen_.size(); ++i) {
            if (!is_object(i)) return false;
        }
        return decoded.functions == model_.functions && decoded.objects == model_.objects;
    }

    TriangleMesh mesh_of_islands() const {
        TriangleMesh mesh;
        for (const std::size_t i : objects_) append(chosen_[i]->mesh, mesh);
        return mesh;
    }

    // What is proved of the islands: no point is farther from all of a surface than from a part of it.
    // Nothing if the input is more than the islands, or was moved.
    std::optional<Deviation> maximum_of_islands() const {
        if (prepared_.defects.degenerate_faces > 0 || prepared_.defects.seam_edges > 0) return {};
        Deviation all;
        all.certified = true;
        for (const std::size_t i : objects_) {
            if (!chosen_[i]->deviation.certified) return {};
            take_maximum(chosen_[i]->deviation, all);
        }
        return all;
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
            const std::optional<Outcome>& outcome = outcome_of(i);
            island.candidate = is_object(i) ? outcome->candidate : "mesh";
            const Object& object = is_object(i) ? outcome->object : model_.objects.back();
            const auto* part = std::get_if<MeshPart>(&object.shape);
            if (part != nullptr && part->curved()) island.candidate = "patches";
            island.copies =
                outcome ? std::max<std::int64_t>(1, std::ssize(outcome->object.placements.list)) : 1;
            island.bytes =
                outcome ? static_cast<double>(outcome->bytes) / static_cast<double>(island.copies) : 0;
            r.islands.push_back(island);
        }
    }

    const TriangleMesh& input_;
    const FaceMaterials& materials_;
    const CompressOptions& options_;
    const Task& task_;
    double tolerance_ = 0;
    double share_ = 1;  // of the tolerance, that the islands may use
    PreparedMesh prepared_;
    std::vector<std::optional<Outcome>> chosen_;    // of copies: at the first of them
    std::vector<std::size_t> first_of_;             // island -> the first of its copies, or itself
    std::vector<std::vector<std::size_t>> copies_;  // of those: the islands, in the order of the placements
    std::vector<std::vector<std::vector<std::size_t>>>
        islands_of_;                    // for each object, for each of its copies
    std::vector<std::size_t> objects_;  // rows of chosen_, in the model's order
    std::optional<Deviation> of_mesh_part_;
    Model model_;
    Compressed result_;
};

}  // namespace

Compressed compress(const TriangleMesh& mesh, const CompressOptions& options, const Task& task) {
    const FaceMaterials none;
    return Compressor(mesh, none, options, task).run();
}

Compressed compress(const PaintedMesh& mesh, const CompressOptions& options, const Task& task) {
    return Compressor(mesh.mesh, mesh.materials, options, task).run();
}

}  // namespace pfgeom
