#include "pfgeom/algebra/merge.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

using Kind = CombinationStep::Kind;

// The functions that a shape names, one after the other; `visit` may change the index.
template <class Shape, class Visit>
void for_each_function(Shape& shape, Visit visit) {
    if (auto* sheet = std::get_if<Sheet>(&shape)) {
        visit(sheet->surface);
        if (sheet->trim >= 0) visit(sheet->trim);
    }
    if (auto* solid = std::get_if<Solid>(&shape)) {
        for (SetNode& node : solid->nodes) {
            if (node.kind == SetNode::Kind::function) visit(node.a);
            if (node.kind == SetNode::Kind::decide) visit(node.f);
        }
    }
}

class Merger {
  public:
    Merger(const Model& model, Model& all)
        : model_(model), all_(all), function_(model.functions.size(), -1) {}

    void run() {
        const Combination own = combination_of(model_);
        std::int32_t first = 0;
        std::vector<std::int32_t> row;
        for (const Operand& operand : own.operands) {
            row.push_back(find_or_add(operand, first));
            first += operand.objects;
        }
        Combination& c = all_.combination;
        for (CombinationStep step : own.steps) {
            if (step.kind == Kind::operand) step.row = row[static_cast<std::size_t>(step.row)];
            if (step.kind == Kind::transform) {
                c.transforms.push_back(own.transforms[static_cast<std::size_t>(step.row)]);
                step.row = static_cast<std::int32_t>(c.transforms.size()) - 1;
            }
            c.steps.push_back(step);
        }
    }

  private:
    static Combination combination_of(const Model& model) {
        if (!model.combination.empty()) return model.combination;
        Combination alone;
        alone.operands = {{static_cast<std::int32_t>(model.objects.size()), model.diagonal, model.promise}};
        alone.steps = {{Kind::operand, 0}};
        return alone;
    }

    std::int32_t find_or_add(const Operand& operand, std::int32_t first) {
        std::int32_t there = 0;
        std::vector<Operand>& operands = all_.combination.operands;
        for (std::size_t i = 0; i < operands.size(); ++i) {
            if (operands[i] == operand && same_objects(operand.objects, first, there))
                return static_cast<std::int32_t>(i);
            there += operands[i].objects;
        }
        for (std::int32_t i = 0; i < operand.objects; ++i) add(model_.objects[first + i], there - first);
        operands.push_back(operand);
        return static_cast<std::int32_t>(operands.size()) - 1;
    }

    // `moved`: how much further back its operand stands now.
    void add(Object object, std::int32_t moved) {
        if (object.cavity_of >= 0) object.cavity_of += moved;
        for_each_function(object.shape, [this](std::int32_t& f) { f = function_of(f); });
        all_.objects.push_back(std::move(object));
    }

    std::int32_t function_of(std::int32_t f) {
        std::int32_t& row = function_[static_cast<std::size_t>(f)];
        if (row < 0) {
            row = static_cast<std::int32_t>(all_.functions.size());
            all_.functions.push_back(model_.functions[static_cast<std::size_t>(f)]);
        }
        return row;
    }

    bool same_objects(std::int32_t count, std::int32_t here, std::int32_t there) const {
        for (std::int32_t i = 0; i < count; ++i) {
            if (!same(model_.objects[here + i], here, all_.objects[there + i], there)) return false;
        }
        return true;
    }

    // But for the numbers of what they name, which must be the same.
    bool same(Object a, std::int32_t first_a, Object b, std::int32_t first_b) const {
        std::vector<const Function*> fa, fb;
        for_each_function(a.shape, [&](std::int32_t& f) {
            fa.push_back(&model_.functions[static_cast<std::size_t>(f)]);
            f = 0;
        });
        for_each_function(b.shape, [&](std::int32_t& f) {
            fb.push_back(&all_.functions[static_cast<std::size_t>(f)]);
            f = 0;
        });
        if (a.cavity_of >= 0) a.cavity_of -= first_a;
        if (b.cavity_of >= 0) b.cavity_of -= first_b;
        return a == b && std::equal(fa.begin(), fa.end(), fb.begin(), fb.end(),
                                    [](const Function* f, const Function* g) { return *f == *g; });
    }

    const Model& model_;
    Model& all_;
    std::vector<std::int32_t> function_;  // what has become of the model's
};

}  // namespace

void append_operands(const Model& model, Model& all) {
    Merger(model, all).run();
}

}  // namespace pfgeom
