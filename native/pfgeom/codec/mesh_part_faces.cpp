#include "pfgeom/codec/mesh_part_faces.h"

namespace pfgeom {

FacesLeft::FacesLeft(const std::vector<Triangle>& faces, std::size_t vertices)
    : faces_(faces), first_(vertices + 1, 0), taken_(faces.size(), 0) {
    for (const Triangle& t : faces) {
        for (const std::int32_t v : t) ++first_[static_cast<std::size_t>(v) + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    at_vertex_.resize(3 * faces.size());
    std::vector<std::int32_t> fill(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (const std::int32_t v : faces[f]) {
            at_vertex_[static_cast<std::size_t>(fill[static_cast<std::size_t>(v)]++)] =
                static_cast<std::int32_t>(f);
        }
    }
    last_ = std::move(fill);
}

FacesLeft::Found FacesLeft::at_edge(std::int32_t from, std::int32_t to, bool flipped) {
    const auto size = [&](std::int32_t v) {
        return last_[static_cast<std::size_t>(v)] - first_[static_cast<std::size_t>(v)];
    };
    const auto around = static_cast<std::size_t>(size(from) <= size(to) ? from : to);
    forget_taken(around);
    Found found;
    for (std::int32_t i = first_[around]; i < last_[around]; ++i) {
        const std::int32_t face = at_vertex_[static_cast<std::size_t>(i)];
        const Triangle& t = faces_[static_cast<std::size_t>(face)];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const bool forward = a == from && b == to, backward = a == to && b == from;
            if (!forward && !backward) continue;
            if (backward == flipped) return {face, c, backward};
            if (found.face < 0) found = {face, c, backward};
        }
    }
    return found;
}

// Keeps the order of the rest.
void FacesLeft::forget_taken(std::size_t v) {
    std::int32_t end = first_[v];
    for (std::int32_t i = first_[v]; i < last_[v]; ++i) {
        const std::int32_t face = at_vertex_[static_cast<std::size_t>(i)];
        if (taken_[static_cast<std::size_t>(face)] == 0) at_vertex_[static_cast<std::size_t>(end++)] = face;
    }
    last_[v] = end;
}

std::int32_t FacesLeft::lowest() {
    while (next_ < taken_.size() && taken_[next_] != 0) ++next_;
    return next_ < taken_.size() ? static_cast<std::int32_t>(next_) : -1;
}

}  // namespace pfgeom
