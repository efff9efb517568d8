#include "block_ldlt.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr std::uint32_t kNotEliminated = ~std::uint32_t{0};  // position of what is not eliminated

/// L·D·Lᵀ of a symmetric block, in place: D on the diagonal, L below it. Only the lower half is read.
void factoriseBlock(Block33& m) {
    m[3] /= m[0];
    const double d1 = m[4] - m[3] * m[3] * m[0];
    const double l20 = m[6] / m[0];
    const double below = m[7] - l20 * m[3] * m[0];
    m[4] = d1;
    m[7] = below / d1;
    m[8] -= l20 * l20 * m[0] + m[7] * below;
    m[6] = l20;
}

Block3 solveBlock(const Block33& m, Block3 v) {
    v[1] -= m[3] * v[0];
    v[2] -= m[6] * v[0] + m[7] * v[1];
    v[0] /= m[0];
    v[1] /= m[4];
    v[2] /= m[8];
    v[1] -= m[7] * v[2];
    v[0] -= m[3] * v[1] + m[6] * v[2];
    return v;
}

/// v −= m·x
void subtract(Block3& v, const Block33& m, const Block3& x) {
    for (std::size_t i = 0; i < 3; ++i) { v[i] -= m[3 * i] * x[0] + m[3 * i + 1] * x[1] + m[3 * i + 2] * x[2]; }
}
/// v −= mᵀ·x
void subtractTransposed(Block3& v, const Block33& m, const Block3& x) {
    for (std::size_t i = 0; i < 3; ++i) { v[i] -= m[i] * x[0] + m[3 + i] * x[1] + m[6 + i] * x[2]; }
}

/// target −= a·bᵀ
void subtractProduct(Block33& target, const Block33& a, const Block33& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            target[3 * i + k] -= a[3 * i] * b[3 * k] + a[3 * i + 1] * b[3 * k + 1] + a[3 * i + 2] * b[3 * k + 2];
        }
    }
}

void addUnique(std::vector<std::uint32_t>& sorted, std::uint32_t value) {
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
    if (place == sorted.end() || *place != value) { sorted.insert(place, value); }
}

}  // namespace

bool BlockLdlt::analyse(std::uint32_t nodes, std::span<const BlockEdge> edges, std::size_t mostBlocks) {
    const NodeRange whole{0, nodes};
    return analyse({&whole, 1}, edges, mostBlocks);
}

bool BlockLdlt::analyse(std::span<const NodeRange> parts, std::span<const BlockEdge> edges, std::size_t mostBlocks) {
    const auto isSame = [](const BlockEdge& x, const BlockEdge& y) { return x.a == y.a && x.b == y.b; };
    const auto isSamePart = [](const NodeRange& x, const NodeRange& y) { return x.begin == y.begin && x.end == y.end; };
    if (mostBlocks == mostBlocks_ && std::equal(parts.begin(), parts.end(), parts_.begin(), parts_.end(), isSamePart) &&
        std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end(), isSame)) {
        return fits_;
    }
    edges_.assign(edges.begin(), edges.end());
    parts_.assign(parts.begin(), parts.end());
    mostBlocks_ = mostBlocks;
    const std::uint32_t nodes = parts.empty() ? 0 : parts.back().end;
    if (neighbours_.size() < nodes) { neighbours_.resize(nodes); }
    for (std::uint32_t i = 0; i < nodes; ++i) { neighbours_[i].clear(); }
    for (const BlockEdge& edge : edges) {
        addUnique(neighbours_[edge.a], edge.b);
        addUnique(neighbours_[edge.b], edge.a);
    }
    position_.assign(nodes, kNotEliminated);
    begins_.assign(1, 0);
    rows_.clear();
    fits_ = std::all_of(parts.begin(), parts.end(),
                        [this, mostBlocks](const NodeRange& part) { return order(part, mostBlocks); });
    if (fits_) { place(); }
    return fits_;
}

bool BlockLdlt::order(NodeRange part, std::size_t mostBlocks) {
    const std::greater<> later;
    heap_.clear();
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
        heap_.emplace_back(static_cast<std::uint32_t>(neighbours_[i].size()), i);
    }
    std::make_heap(heap_.begin(), heap_.end(), later);
    std::uint32_t next = part.begin;
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), later);
        const auto [degree, node] = heap_.back();
        heap_.pop_back();
        // Entries are not updated but added anew: those of an older degree are passed over.
        if (position_[node] != kNotEliminated || degree != neighbours_[node].size()) { continue; }
        position_[node] = next++;
        rows_.insert(rows_.end(), neighbours_[node].begin(), neighbours_[node].end());
        begins_.push_back(static_cast<std::uint32_t>(rows_.size()));
        if (rows_.size() > mostBlocks) { return false; }
        eliminate(node);
    }
    return true;
}

/// The neighbours of an eliminated node become neighbours of each other.
void BlockLdlt::eliminate(std::uint32_t node) {
    const std::vector<std::uint32_t>& clique = neighbours_[node];
    for (const std::uint32_t member : clique) {
        std::vector<std::uint32_t>& old = neighbours_[member];
        merged_.clear();
        std::set_union(old.begin(), old.end(), clique.begin(), clique.end(), std::back_inserter(merged_));
        std::erase_if(merged_, [member, node](std::uint32_t i) { return i == member || i == node; });
        old.swap(merged_);
        heap_.emplace_back(static_cast<std::uint32_t>(old.size()), member);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
}

std::uint32_t BlockLdlt::blockAt(std::uint32_t row, std::uint32_t column) const {
    const std::uint32_t* const rows = rows_.data();
    return static_cast<std::uint32_t>(std::lower_bound(rows + begins_[column], rows + begins_[column + 1], row) - rows);
}

void BlockLdlt::place() {
    const auto columns = static_cast<std::uint32_t>(position_.size());
    for (std::uint32_t& row : rows_) { row = position_[row]; }
    for (std::uint32_t c = 0; c < columns; ++c) { std::sort(rows_.data() + begins_[c], rows_.data() + begins_[c + 1]); }
    targets_.clear();
    std::size_t pairs = 0;
    for (std::uint32_t c = 0; c < columns; ++c) {
        const std::size_t count = begins_[c + 1] - begins_[c];
        pairs += count * (count + 1) / 2;
    }
    if (targets_.capacity() < pairs) { targets_.reserve(std::max(pairs, 2 * targets_.capacity())); }
    targetBegins_.clear();
    for (std::uint32_t c = 0; c < columns; ++c) {
        targetBegins_.push_back(targets_.size());
        for (std::uint32_t i = begins_[c]; i < begins_[c + 1]; ++i) {
            for (std::uint32_t k = begins_[c]; k < i; ++k) { targets_.push_back(blockAt(rows_[i], rows_[k])); }
            targets_.push_back(kDiagonalBit | rows_[i]);
        }
    }
    diagonal_.resize(columns);
    blocks_.resize(rows_.size());
    scratch_.resize(columns);
}

BlockLdlt::OffDiagonal BlockLdlt::offDiagonal(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t placeA = position_[a];
    const std::uint32_t placeB = position_[b];
    return {blocks_[blockAt(std::max(placeA, placeB), std::min(placeA, placeB))], placeB > placeA};
}

void BlockLdlt::clear(NodeRange part) {
    std::fill(diagonal_.data() + part.begin, diagonal_.data() + part.end, Block33{});
    std::fill(blocks_.data() + begins_[part.begin], blocks_.data() + begins_[part.end], Block33{});
}

void eliminateColumn(const BlockColumn& column, std::span<SpreadBlock> scratch) {
    const std::span<Block33> blocks = column.blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i) { scratch[i].block = blocks[i]; }
    const std::uint32_t* target = column.targets;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        // Rows of the block times D⁻¹, which is symmetric.
        Block33& block = blocks[i];
        for (std::size_t r = 0; r < 3; ++r) {
            const Block3 row = solveBlock(column.diagonal, {block[3 * r], block[3 * r + 1], block[3 * r + 2]});
            std::copy(row.begin(), row.end(), block.begin() + static_cast<std::ptrdiff_t>(3 * r));
        }
        for (std::size_t k = 0; k <= i; ++k, ++target) {
            const bool isDiagonal = (*target & kDiagonalBit) != 0;
            Block33& into = isDiagonal ? column.diagonals[*target & ~kDiagonalBit] : column.all[*target];
            subtractProduct(into, block, scratch[k].block);
        }
    }
}

#ifndef SWEPT_SIMD
EliminateColumn columnKernel() { return nullptr; }
#endif

void BlockLdlt::factorise(NodeRange part) {
    const EliminateColumn kernel = columnKernel();
    const EliminateColumn take = kernel != nullptr ? kernel : eliminateColumn;
    for (std::uint32_t c = part.begin; c < part.end; ++c) {
        factoriseBlock(diagonal_[c]);
        const std::size_t count = begins_[c + 1] - begins_[c];
        if (count == 0) { continue; }
        if (spread_.size() < count) { spread_.resize(count); }
        const std::span<Block33> blocks(blocks_.data() + begins_[c], count);
        take({diagonal_[c], blocks, targets_.data() + targetBegins_[c], diagonal_.data(), blocks_.data()}, spread_);
    }
}

void BlockLdlt::eliminate(std::uint32_t position, std::span<Block3> ordered) const {
    for (std::uint32_t i = begins_[position]; i < begins_[position + 1]; ++i) {
        subtract(ordered[rows_[i]], blocks_[i], ordered[position]);
    }
}

Block3 BlockLdlt::divided(std::uint32_t position, const Block3& value) const {
    return solveBlock(diagonal_[position], value);
}

void BlockLdlt::beginSolve(std::span<const Block3> values, std::span<Block3> ordered, NodeRange part) const {
    for (std::uint32_t node = part.begin; node < part.end; ++node) { ordered[position_[node]] = values[node]; }
    for (std::uint32_t c = part.begin; c < part.end; ++c) { eliminate(c, ordered); }
}

void BlockLdlt::endSolve(std::span<Block3> values, std::span<Block3> ordered, NodeRange part) const {
    for (std::uint32_t c = part.end; c-- > part.begin;) {
        ordered[c] = solveBlock(diagonal_[c], ordered[c]);
        for (std::uint32_t i = begins_[c]; i < begins_[c + 1]; ++i) {
            subtractTransposed(ordered[c], blocks_[i], ordered[rows_[i]]);
        }
    }
    for (std::uint32_t node = part.begin; node < part.end; ++node) { values[node] = ordered[position_[node]]; }
}

void BlockLdlt::solve(std::span<Block3> values, NodeRange part) const {
    beginSolve(values, scratch_, part);
    endSolve(values, scratch_, part);
}

}  // namespace swept::inline SWEPT_PRECISION
