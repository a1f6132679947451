// The stages' costs on one generated mesh, the pebble of the determinism test.

#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/mesh/mesh.h"
#include "pfgeom/report/deviation.h"
#include "scenes.h"

#include <benchmark/benchmark.h>

namespace {

const scenes::Scene& pebble() {
    static const scenes::Scene scene = [] {
        for (auto& s : scenes::all()) {
            if (s.name == "pebble") return s;
        }
        return scenes::Scene{};
    }();
    return scene;
}

const pfgeom::Compressed& compressed() {
    static const pfgeom::Compressed result =
        pfgeom::compress(pebble().mesh, {.tolerance = pebble().tolerance});
    return result;
}

void bvh_build(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(pfgeom::Bvh(pebble().mesh));
}
BENCHMARK(bvh_build)->Unit(benchmark::kMillisecond);

void bvh_closest(benchmark::State& state) {
    const pfgeom::Bvh bvh(pebble().mesh);
    const auto samples = pfgeom::sample_surface(pebble().mesh, 1000, 1);
    for (auto _ : state) {
        for (const auto& p : samples.points) benchmark::DoNotOptimize(bvh.closest(p * 1.01));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.points.size()));
}
BENCHMARK(bvh_closest)->Unit(benchmark::kMillisecond);

void field_value(benchmark::State& state) {
    const pfgeom::ModelField field(compressed().model);
    const auto samples = pfgeom::sample_surface(pebble().mesh, 1000, 1);
    for (auto _ : state) {
        for (const auto& p : samples.points) benchmark::DoNotOptimize(field.value(p));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples.points.size()));
}
BENCHMARK(field_value)->Unit(benchmark::kMillisecond);

void compress(benchmark::State& state) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(pfgeom::compress(pebble().mesh, {.tolerance = pebble().tolerance}));
    }
}
BENCHMARK(compress)->Unit(benchmark::kMillisecond)->UseRealTime();

void decode(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(pfgeom::decode(compressed().bytes));
}
BENCHMARK(decode)->Unit(benchmark::kMillisecond);

void to_mesh(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(pfgeom::to_mesh(compressed().model));
}
BENCHMARK(to_mesh)->Unit(benchmark::kMillisecond)->UseRealTime();

void measure_deviation(benchmark::State& state) {
    const pfgeom::TriangleMesh rebuilt = pfgeom::to_mesh(compressed().model);
    for (auto _ : state) benchmark::DoNotOptimize(pfgeom::measure_deviation(pebble().mesh, rebuilt));
}
BENCHMARK(measure_deviation)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
