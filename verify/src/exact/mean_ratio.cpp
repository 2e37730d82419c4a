#include "exact/mean_ratio.hpp"

#include <optional>
#include <utility>

#include "exact/near_one.hpp"
#include "exact/vectors.hpp"

namespace octetra::verify::exact {
namespace {

/// Returns whether the mean ratio is less than the limit; nothing if undecided.
template <class T>
std::optional<bool> is_less(const std::array<Point, 4>& p, double limit) {
    const auto u = between<T>(p[0], p[1]);
    const auto v = between<T>(p[0], p[2]);
    const auto w = between<T>(p[0], p[3]);
    const T volume = dot(u, cross(v, w));
    T squares = dot(u, u) + dot(v, v) + dot(w, w);
    for (const auto& [i, j] : {std::pair{1U, 2U}, {1U, 3U}, {2U, 3U}}) {
        const auto edge = between<T>(p[i], p[j]);
        squares = T(squares + dot(edge, edge));
    }
    const T scaled = T(limit) * squares;
    const auto excess = sign_of(T(T(432) * volume * volume - scaled * scaled * scaled));
    if (!excess) return std::nullopt;
    return *excess < 0;
}

}  // namespace

bool is_mean_ratio_less(const std::array<Point, 4>& corners, double limit, Arithmetic& arithmetic) {
    const auto p = near_one(corners);
    {
        const Interval::Protector upward;
        if (const auto less = is_less<Interval>(p, limit)) {
            ++arithmetic.filtered;
            return *less;
        }
    }
    ++arithmetic.exact;
    return is_less<mpq_class>(p, limit).value();
}

}  // namespace octetra::verify::exact
