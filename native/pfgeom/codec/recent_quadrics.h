// The quadrics that a tree has asked so far, the most recently asked first: a doubly linked list over their
// indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

class RecentQuadrics {
  public:
    static constexpr std::int32_t kEnd = -1;

    std::size_t size() const { return links_.size(); }
    std::int32_t first() const { return first_; }
    std::int32_t after(std::int32_t quadric) const { return at(quadric).next; }

    /// The quadric with the next index, in front.
    void add() {
        links_.emplace_back();
        put_in_front(static_cast<std::int32_t>(links_.size()) - 1);
    }
    void move_to_front(std::int32_t quadric) {
        if (quadric == first_) return;
        const Link link = at(quadric);
        at(link.before).next = link.next;  // not the first: there is one before
        if (link.next != kEnd) at(link.next).before = link.before;
        put_in_front(quadric);
    }

  private:
    struct Link {
        std::int32_t before = kEnd, next = kEnd;
    };
    Link& at(std::int32_t quadric) { return links_[static_cast<std::size_t>(quadric)]; }
    const Link& at(std::int32_t quadric) const { return links_[static_cast<std::size_t>(quadric)]; }
    void put_in_front(std::int32_t quadric) {
        at(quadric) = {kEnd, first_};
        if (first_ != kEnd) at(first_).before = quadric;
        first_ = quadric;
    }

    std::vector<Link> links_;
    std::int32_t first_ = kEnd;
};

}  // namespace pfgeom
