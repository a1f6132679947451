#include "pfgeom/function/check.h"
#include "pfgeom/function/model.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

using Kind = CombinationStep::Kind;

// What a step leaves on the stack.
struct Term {
    int depth = 0;
    bool open = false;  // an object of it is a sheet
};

class Checker {
  public:
    explicit Checker(const Model& model) : model_(model), c_(model.combination) {}

    std::string run() {
        if (c_.empty())
            return c_.operands.empty() && c_.transforms.empty() ? "" : "operands are not combined";
        if (c_.steps.size() > Combination::kMostSteps) return "a combination has more than 16384 steps";
        if (std::string flaw = flaw_of_operands(); !flaw.empty()) return flaw;
        for (const CombinationStep& step : c_.steps) {
            if (std::string flaw = take(step); !flaw.empty()) return flaw;
            if (stack_.back().depth > Combination::kMostDepth) return "a combination is more than 512 deep";
        }
        if (stack_.size() != 1) return "operands are left over";
        if (operands_ != c_.operands.size() || transforms_ != c_.transforms.size())
            return "an operand or a transform is not used";
        return {};
    }

  private:
    std::string flaw_of_operands() {
        std::size_t object = 0;
        for (const Operand& operand : c_.operands) {
            if (operand.objects < 1 ||
                model_.objects.size() - object < static_cast<std::size_t>(operand.objects))
                return "an operand has no objects, or more than there are";
            if (std::string flaw = find_flaw(operand.promise, operand.diagonal); !flaw.empty())
                return "an operand: " + flaw;
            const auto first = static_cast<std::int32_t>(object);
            open_.push_back(false);
            for (std::int32_t i = 0; i < operand.objects; ++i, ++object) {
                const Object& o = model_.objects[object];
                if (o.cavity_of >= 0 && (o.cavity_of < first || o.cavity_of >= first + operand.objects))
                    return "a cavity is of another operand";
                if (std::holds_alternative<Sheet>(o.shape)) open_.back() = true;
            }
        }
        return object == model_.objects.size() ? "" : "an object belongs to no operand";
    }

    std::string take(const CombinationStep& step) {
        const auto row = static_cast<std::size_t>(step.row);
        if (step.kind == Kind::operand) {
            if (step.row < 0 || row > operands_ || row >= c_.operands.size())
                return "operands are not in the order of their first use";
            operands_ += row == operands_ ? 1 : 0;
            stack_.push_back({1, open_[row]});
            return {};
        }
        if (step.kind == Kind::transform) {
            if (stack_.empty()) return "an operation has no operand";
            if (row != transforms_ || row >= c_.transforms.size()) return "transforms are not in order";
            ++stack_.back().depth;
            return find_flaw(c_.transforms[transforms_++]);
        }
        if (step.kind > Kind::transform) return "a step's kind does not exist";
        if (step.row != -1) return "an operation has a row";
        if (stack_.size() < 2) return "an operation has no operand";
        const Term b = stack_.back();
        stack_.pop_back();
        Term& a = stack_.back();
        if (a.open || b.open) return "an open sheet is an operand of a set operation";
        a.depth = std::max(a.depth, b.depth) + 1;
        return {};
    }

    const Model& model_;
    const Combination& c_;
    std::vector<bool> open_;                     // of each operand
    std::size_t operands_ = 0, transforms_ = 0;  // used so far
    std::vector<Term> stack_;
};

}  // namespace

std::string find_combination_flaw(const Model& model) {
    return Checker(model).run();
}

std::vector<CombinationNode> combination_tree(const Model& model) {
    const Combination& c = model.combination;
    const auto objects = static_cast<std::int32_t>(model.objects.size());
    if (c.empty()) return {{.last = objects, .diagonal = model.diagonal}};
    std::vector<std::int32_t> first{0};
    for (const Operand& operand : c.operands) first.push_back(first.back() + operand.objects);
    // Forwards: who stands on whom. A transform is a node as yet, with one child.
    std::vector<CombinationNode> nodes;
    std::vector<std::int32_t> stack;
    const auto pop = [&stack] {
        const std::int32_t top = stack.back();
        stack.pop_back();
        return top;
    };
    for (const CombinationStep& step : c.steps) {
        CombinationNode node{.kind = step.kind};
        const auto row = static_cast<std::size_t>(step.row);
        if (step.kind == Kind::operand) {
            node.first = first[row];
            node.last = first[row + 1];
            node.diagonal = c.operands[row].diagonal;
        } else {
            if (step.kind != Kind::transform) node.b = pop();
            node.a = pop();
        }
        if (step.kind == Kind::transform) node.place = c.transforms[row];
        stack.push_back(static_cast<std::int32_t>(nodes.size()));
        nodes.push_back(node);
    }
    // Backwards: where each stands, from where its parent does.
    std::vector<Affine> place(nodes.size());
    std::vector<bool> moved(nodes.size(), false);
    for (std::size_t i = nodes.size(); i-- > 0;) {
        CombinationNode& node = nodes[i];
        const bool turns = node.kind == Kind::transform;
        const Affine here = !turns ? place[i] : moved[i] ? composed(place[i], node.place) : node.place;
        for (const std::int32_t child : {node.a, node.b}) {
            if (child < 0) continue;
            place[static_cast<std::size_t>(child)] = here;
            moved[static_cast<std::size_t>(child)] = moved[i] || turns;
        }
        if (node.is_operand()) {
            node.place = place[i];
            node.moved = moved[i];
        }
    }
    // Without the transforms.
    std::vector<CombinationNode> tree;
    std::vector<std::int32_t> now(nodes.size());
    const auto row_of = [&now](std::int32_t i) { return i < 0 ? -1 : now[static_cast<std::size_t>(i)]; };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        CombinationNode node = nodes[i];
        node.a = row_of(node.a);
        node.b = row_of(node.b);
        if (node.kind == Kind::transform) {
            now[i] = node.a;
        } else {
            now[i] = static_cast<std::int32_t>(tree.size());
            tree.push_back(node);
        }
    }
    return tree;
}

}  // namespace pfgeom
