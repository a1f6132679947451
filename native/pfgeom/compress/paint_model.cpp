#include "pfgeom/compress/paint_model.h"

#include "pfgeom/compress/labelled_surface.h"
#include "pfgeom/compress/paint_fit.h"

#include <algorithm>

namespace pfgeom {
namespace {

class ModelPainter {
  public:
    ModelPainter(const Model& model, const PaintGoal& goal, const Task& task)
        : model_(model), goal_(goal), task_(task) {
        const FaceMaterials& given = goal.materials;
        const std::size_t faces = goal.input.faces.size();
        const std::vector<std::int32_t> of_face =
            given.of_face.empty() ? std::vector<std::int32_t>(faces, 0) : given.of_face;
        of_face_ = materials_after(goal.input, of_face, goal.prepared.mesh);
    }

    MaterialMap run() {
        MaterialMap map;
        map.names = goal_.materials.names;
        const std::size_t n = model_.objects.size();
        for (std::size_t i = 0; i < n; ++i) {
            task_.report(static_cast<double>(i) / static_cast<double>(n), "materials");
            map.objects.push_back(paint_object(i));
        }
        return map;
    }
    const PaintError& error() const { return error_; }

  private:
    std::vector<Paint> paint_object(std::size_t i) {
        const Object& object = model_.objects[i];
        std::vector<LabelledSurface> surfaces;
        for (const std::vector<std::size_t>& islands : goal_.islands[i])
            surfaces.push_back(surface_of(islands));
        if (std::all_of(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.plain(); }))
            return plain_paints(surfaces);
        std::vector<PaintedCopy> copies;
        const std::vector<Similarity> places = copies_of(object);
        for (std::size_t c = 0; c < surfaces.size(); ++c) copies.push_back({&surfaces[c], places[c]});
        PaintFit fit(model_, object, goal_.tolerance, goal_.materials.names.size(), goal_.effort, task_);
        if (copies.size() > 1 && !fit.agree(copies)) return paint_each(fit, copies);
        PaintError error;
        Paint paint = fit.fit(copies, error);
        error_ += error;
        return {std::move(paint)};
    }

    std::vector<Paint> paint_each(PaintFit& fit, std::span<const PaintedCopy> copies) {
        std::vector<Paint> paints;
        for (const PaintedCopy& copy : copies) {
            PaintError error;
            paints.push_back(copy.surface->plain() ? plain_paint(copy.surface->any_material())
                                                   : fit.fit({&copy, 1}, error));
            error_ += error;
        }
        return paints;
    }

    std::vector<Paint> plain_paints(const std::vector<LabelledSurface>& surfaces) {
        std::vector<Paint> paints;
        for (const LabelledSurface& s : surfaces) paints.push_back(plain_paint(s.any_material()));
        if (std::all_of(paints.begin(), paints.end(), [&](const Paint& p) { return p == paints.front(); }))
            paints.resize(1);
        return paints;
    }

    LabelledSurface surface_of(const std::vector<std::size_t>& islands) const {
        Island together;
        for (const std::size_t i : islands) {
            const auto& faces = goal_.prepared.islands[i].faces;
            together.faces.insert(together.faces.end(), faces.begin(), faces.end());
        }
        std::sort(together.faces.begin(), together.faces.end());
        std::vector<std::int32_t> materials;
        for (const std::int32_t f : together.faces)
            materials.push_back(of_face_[static_cast<std::size_t>(f)]);
        return {extract_island(goal_.prepared, together), std::move(materials), islands.size() > 1};
    }

    const Model& model_;
    const PaintGoal& goal_;
    const Task& task_;
    std::vector<std::int32_t> of_face_;  // of the prepared mesh
    PaintError error_;
};

}  // namespace

MaterialMap paint_model(const Model& model, const PaintGoal& goal, PaintReport& report, const Task& task) {
    ModelPainter painter(model, goal, task);
    MaterialMap map = painter.run();
    const double area = std::max(surface_area(goal.input), painter.error().area);
    report.right = 1 - painter.error().wrong / area;
    report.stray = painter.error().stray / area;
    return map;
}

}  // namespace pfgeom
