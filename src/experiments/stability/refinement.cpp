#include "experiments/stability/refinement.h"

#include <algorithm>

namespace clothlab::experiments {
namespace {

using Interval = std::pair<std::size_t, std::size_t>;

/// The coarse lattice's intervals along a side.
std::vector<Interval> intervals(const LatticeSide& side, std::size_t blocks) {
    std::vector<Interval> list;
    if (!side.continuous || side.values == 1) {
        for (std::size_t i = 0; i < side.values; ++i)
            list.emplace_back(i, i);
        return list;
    }
    const std::size_t last = side.values - 1, count = std::min(blocks, last);
    for (std::size_t i = 0; i < count; ++i)
        list.emplace_back(i * last / count, (i + 1) * last / count);
    return list;
}

/// The halves of an interval; itself where nothing lies between its ends.
std::vector<Interval> halves(std::size_t from, std::size_t to) {
    if (to - from < 2)
        return {{from, to}};
    const std::size_t middle = from + (to - from) / 2;
    return {{from, middle}, {middle, to}};
}

constexpr std::size_t not_judged = static_cast<std::size_t>(-1);

class Refinement {
public:
    Refinement(const Lattice& lattice, const LatticeJudge& judge)
        : lattice_(lattice), columns_(lattice.x.values), judge_(judge) {
        result_.kind.assign(lattice.x.values * lattice.y.values, 0);
        result_.like.assign(result_.kind.size(), not_judged);
        for (const auto& [x0, x1] : intervals(lattice.x, lattice.blocks))
            for (const auto& [y0, y1] : intervals(lattice.y, lattice.blocks))
                blocks_.push_back({x0, x1, y0, y1});
    }

    Refined run() {
        do
            judge_corners();
        while (divide());
        for (const Block& block : blocks_)
            fill(block);
        return std::move(result_);
    }

private:
    /// From point to point, corners included.
    struct Block {
        std::size_t x0, x1, y0, y1;
    };

    std::size_t at(std::size_t x, std::size_t y) const { return y * columns_ + x; }

    void judge_corners() {
        std::vector<std::size_t> wanted;
        for (const Block& block : blocks_)
            for (const std::size_t y : {block.y0, block.y1})
                for (const std::size_t x : {block.x0, block.x1})
                    if (result_.like[at(x, y)] == not_judged)
                        wanted.push_back(at(x, y));
        std::sort(wanted.begin(), wanted.end());
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        if (wanted.empty())
            return;
        std::vector<LatticePoint> points;
        for (const std::size_t i : wanted)
            points.push_back({i % columns_, i / columns_});
        const std::vector<int> kinds = judge_(points);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            result_.kind[wanted[i]] = kinds[i];
            result_.like[wanted[i]] = result_.judged.size();
            result_.judged.push_back(points[i]);
        }
    }

    bool to_be_divided(const Block& block) const {
        const std::size_t longest = std::max(block.x1 - block.x0, block.y1 - block.y0);
        if (longest < 2)
            return false;
        const bool by_kind = !lattice_.group || longest > lattice_.fine;
        const auto what = [&](std::size_t i) { return by_kind ? result_.kind[i] : lattice_.group(result_.kind[i]); };
        const int first = what(at(block.x0, block.y0));
        for (std::size_t y = block.y0; y <= block.y1; ++y)
            for (std::size_t x = block.x0; x <= block.x1; ++x)
                if (result_.like[at(x, y)] != not_judged && what(at(x, y)) != first)
                    return true;
        return false;
    }

    bool divide() {
        std::vector<Block> blocks;
        bool divided = false;
        for (const Block& block : blocks_) {
            if (!to_be_divided(block)) {
                blocks.push_back(block);
                continue;
            }
            divided = true;
            for (const auto& [x0, x1] : halves(block.x0, block.x1))
                for (const auto& [y0, y1] : halves(block.y0, block.y1))
                    blocks.push_back({x0, x1, y0, y1});
        }
        blocks_ = std::move(blocks);
        return divided;
    }

    void fill(const Block& block) {
        for (std::size_t y = block.y0; y <= block.y1; ++y)
            for (std::size_t x = block.x0; x <= block.x1; ++x) {
                const std::size_t corner = at(x - block.x0 <= block.x1 - x ? block.x0 : block.x1,
                                              y - block.y0 <= block.y1 - y ? block.y0 : block.y1);
                if (result_.like[at(x, y)] != not_judged)
                    continue;
                result_.like[at(x, y)] = result_.like[corner];
                result_.kind[at(x, y)] = result_.kind[corner];
            }
    }

    const Lattice& lattice_;
    std::size_t columns_;
    const LatticeJudge& judge_;
    std::vector<Block> blocks_;
    Refined result_;
};

} // namespace

Refined refine(const Lattice& lattice, const LatticeJudge& judge) {
    return Refinement(lattice, judge).run();
}

} // namespace clothlab::experiments
