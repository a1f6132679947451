// The sparse least-squares system of one level: how each coefficient moves the residual of each sample.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// What a level is fitted to. Residual of sample s: weight · (distance of value + change to [lo, hi]).
struct LevelSamples {
    std::vector<Vec3> points;
    std::vector<double> values;  ///< F of the levels before
    std::vector<double> weights;
    std::vector<float> lo, hi;  ///< the interval that F should lie in

    void add(const Vec3& point, double value, double weight, double low, double high) {
        points.push_back(point);
        values.push_back(value);
        weights.push_back(weight);
        lo.push_back(static_cast<float>(low));
        hi.push_back(static_cast<float>(high));
    }
};

/// Column i: the samples in ball i, with d(weighted F) / d(z_i).
struct Columns {
    struct Entry {
        std::int32_t sample;
        float slope;
    };
    std::vector<std::uint32_t> first;  ///< #C + 1
    std::vector<Entry> entries;
    std::vector<double> energy;  ///< Σ slope², 0 where hardly any sample lies: left alone

    std::span<const Entry> of(std::size_t i) const {
        return std::span(entries).subspan(first[i], first[i + 1] - first[i]);
    }
};

Columns make_columns(const Level& level, const LevelSamples& samples, const Task& task);

}  // namespace pfgeom
