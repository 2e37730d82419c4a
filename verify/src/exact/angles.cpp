#include "exact/angles.hpp"

#include <mpfr.h>

#include <cmath>
#include <optional>

#include "exact/near_one.hpp"
#include "exact/vectors.hpp"

namespace octetra::verify::exact {
namespace {

/// The cosine of an angle as numerator / sqrt(square), square > 0.
template <class T>
struct Cosine {
    T numerator;
    T square;
};

template <class T>
Cosine<T> cosine_between(const Vector<T>& u, const Vector<T>& v) {
    return {dot(u, v), dot(u, u) * dot(v, v)};
}

template <class T>
Cosine<T> dihedral_cosine(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto edge = between<T>(a, b);
    return cosine_between(cross(edge, between<T>(a, c)), cross(edge, between<T>(a, d)));
}

/// Returns whether numerator / sqrt(square) > c, given the sign of c and c squared; nothing if
/// undecided.
template <class T>
std::optional<bool> is_greater(const Cosine<T>& cosine, int sign_of_c, const T& c_squared) {
    const auto sign = sign_of(cosine.numerator);
    if (!sign) return std::nullopt;
    if (*sign >= 0 && sign_of_c < 0) return true;
    if (*sign <= 0 && sign_of_c >= 0) return false;
    const auto excess =
        sign_of(T(T(cosine.numerator * cosine.numerator) - T(c_squared * cosine.square)));
    if (!excess) return std::nullopt;
    return sign_of_c >= 0 ? *excess > 0 : *excess < 0;
}

/// Returns whether the angle is more than 60 degrees, and so not the smallest of its triangle;
/// nothing if undecided. The square decides right angles, for which an interval cannot determine
/// the sign of the cosine.
template <class T>
std::optional<bool> is_over_60_degrees(const Cosine<T>& angle) {
    const auto sign = sign_of(angle.numerator);
    if (sign && *sign <= 0) return true;
    const auto excess = sign_of(T(angle.square - T(4) * angle.numerator * angle.numerator));
    if (!excess) return std::nullopt;
    return *excess > 0;
}

/// Returns whether the angle is at least 30 degrees, and so at least half of the smallest angle of
/// any triangle; nothing if undecided.
template <class T>
std::optional<bool> is_30_degrees_or_more(const Cosine<T>& angle) {
    const auto sign = sign_of(angle.numerator);
    if (sign && *sign <= 0) return true;
    const auto excess = sign_of(T(T(3) * angle.square - T(4) * angle.numerator * angle.numerator));
    if (!excess) return std::nullopt;
    return *excess >= 0;
}

/// Returns whether cos(piece's angle) > cos(whole's angle / 2), for less than 30 and at most 60
/// degrees, respectively: with r the square of the former cosine, this is 2 r - 1 > cos(whole's
/// angle), where both sides are positive.
template <class T>
std::optional<bool> is_less_than_half(const Cosine<T>& piece, const Cosine<T>& whole) {
    // With r = n^2 / s: (2 n^2 - s) / s > m / sqrt(t).
    const T twice_less_one = T(2) * piece.numerator * piece.numerator - piece.square;
    if (sign_of(piece.numerator) != 1 || sign_of(twice_less_one) != 1 ||
        sign_of(whole.numerator) != 1) {
        return std::nullopt;  // the angles are too close to these bounds for T
    }
    const T left = twice_less_one * twice_less_one * whole.square;
    const T right = whole.numerator * whole.numerator * piece.square * piece.square;
    const auto excess = sign_of(T(left - right));
    if (!excess) return std::nullopt;
    return *excess > 0;
}

template <class T>
Cosine<T> cosine_at(const std::array<Point, 3>& triangle, std::size_t k) {
    return cosine_between(between<T>(triangle[k], triangle[(k + 1) % 3]),
                          between<T>(triangle[k], triangle[(k + 2) % 3]));
}

/// Compares every angle of the piece with every angle of the whole that may be the smallest: if
/// half of any angle is kept, half of the smallest is.
template <class T>
std::optional<bool> has_angle_less_than_half_of_all(const std::array<Point, 3>& piece,
                                                    const std::array<Point, 3>& whole) {
    bool undecided = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto angle = cosine_at<T>(piece, i);
        if (is_30_degrees_or_more(angle) == true) continue;
        bool less_than_all = true;
        bool unknown = false;
        for (std::size_t k = 0; k < 3 && less_than_all; ++k) {
            const auto other = cosine_at<T>(whole, k);
            if (is_over_60_degrees(other) == true) continue;
            const auto less = is_less_than_half(angle, other);
            if (!less) {
                unknown = true;
            } else if (!*less) {
                less_than_all = false;
            }
        }
        if (!less_than_all) continue;
        if (!unknown) return true;
        undecided = true;
    }
    if (undecided) return std::nullopt;
    return false;
}

/// Returns whether floating point shows that all angles of a triangle are at least 30 degrees, and
/// so at least half of the smallest angle of any triangle.
bool has_only_wide_angles(const std::array<Point, 3>& triangle) {
    constexpr auto is_moderate = [](double square) {
        return square > 0x1p-400 && square < 0x1p400;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const auto u = between<double>(triangle[k], triangle[(k + 1) % 3]);
        const auto v = between<double>(triangle[k], triangle[(k + 2) % 3]);
        const double cosine = dot(u, v);
        const double uu = dot(u, u);
        const double vv = dot(v, v);
        if (!is_moderate(uu) || !is_moderate(vv)) return false;  // underflow would matter
        // Each product in `cosine` passes 6 roundings, and so the cosine is off by at most 6 *
        // 2^-53 |u| |v|; uu * vv passes 11. Relative to uu * vv, the two sides of the comparison
        // are off by less than 100 * 2^-53 together.
        if (cosine > 0 && 4 * cosine * cosine > (3 - 0x1p-44) * (uu * vv)) return false;
    }
    return true;
}

mpq_class rational(const mpfr_t x) {
    mpz_class mantissa;
    const mpfr_exp_t exponent = mpfr_get_z_2exp(mantissa.get_mpz_t(), x);
    mpq_class result(mantissa);
    if (exponent >= 0) {
        mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    } else {
        mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    }
    return result;
}

/// The cosine of the given angle (times pi / 180), rounded down or up throughout; the angle itself
/// is rounded in the opposite direction, since the cosine decreases.
mpq_class cosine_of_degrees(double degrees, mpfr_rnd_t cosine_rounding) {
    constexpr mpfr_prec_t bits = 400;
    const mpfr_rnd_t angle_rounding = cosine_rounding == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDD;
    mpfr_t x;
    mpfr_init2(x, bits);
    mpfr_const_pi(x, angle_rounding);
    mpfr_mul_d(x, x, degrees, angle_rounding);
    mpfr_div_ui(x, x, 180, angle_rounding);
    mpfr_cos(x, x, cosine_rounding);
    mpq_class result = rational(x);
    mpfr_clear(x);
    mpfr_free_cache();  // the thread's cache of constants
    return result;
}

}  // namespace

struct AngleLimit::State {
    int sign = 0;  ///< sign of the cosine
    mpq_class low_square;
    mpq_class high_square;
    Interval interval{0};
};

AngleLimit::AngleLimit(double degrees) : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.sign = degrees < 90 ? 1 : degrees > 90 ? -1 : 0;
    if (degrees == 90) {
        s.low_square = s.high_square = 0;
    } else if (degrees == 60 || degrees == 120) {
        s.low_square = s.high_square = mpq_class(1, 4);
    } else if (degrees == 45 || degrees == 135) {
        s.low_square = s.high_square = mpq_class(1, 2);
    } else if (degrees == 30 || degrees == 150) {
        s.low_square = s.high_square = mpq_class(3, 4);
    } else if (degrees == 0 || degrees == 180) {
        s.low_square = s.high_square = 1;
    } else {
        const mpq_class low = cosine_of_degrees(degrees, MPFR_RNDD);
        const mpq_class high = cosine_of_degrees(degrees, MPFR_RNDU);
        s.low_square = degrees < 90 ? low * low : high * high;
        s.high_square = degrees < 90 ? high * high : low * low;
    }
    const double near = s.low_square.get_d();
    s.interval =
        Interval(std::nextafter(near, -1.0), std::nextafter(std::nextafter(near, 2.0), 2.0));
    if (s.low_square == s.high_square && s.low_square == near) s.interval = Interval(near);
}

AngleLimit::~AngleLimit() = default;

bool AngleLimit::exceeds_dihedral(const Point& p, const Point& q, const Point& r, const Point& s,
                                  Arithmetic& arithmetic) const {
    const auto [a, b, c, d] = near_one<4>({p, q, r, s});
    {
        const Interval::Protector upward;
        const auto greater =
            is_greater(dihedral_cosine<Interval>(a, b, c, d), state_->sign, state_->interval);
        if (greater) {
            ++arithmetic.filtered;
            return *greater;
        }
    }
    ++arithmetic.exact;
    // The cosine for rational corners lies between the two enclosing values only with a probability
    // of about 2^-390; the angle then counts as large enough.
    const auto cosine = dihedral_cosine<mpq_class>(a, b, c, d);
    return *is_greater(cosine, state_->sign,
                       state_->sign >= 0 ? state_->high_square : state_->low_square);
}

bool keeps_half_of_smallest_angle(const std::array<Point, 3>& given_piece,
                                  const std::array<Point, 3>& given_whole, Arithmetic& arithmetic) {
    const auto piece = near_one(given_piece);
    if (has_only_wide_angles(piece)) {
        ++arithmetic.filtered;
        return true;
    }
    const auto whole = near_one(given_whole);
    {
        const Interval::Protector upward;
        if (const auto less = has_angle_less_than_half_of_all<Interval>(piece, whole)) {
            ++arithmetic.filtered;
            return !*less;
        }
    }
    ++arithmetic.exact;
    return !has_angle_less_than_half_of_all<mpq_class>(piece, whole).value();
}

}  // namespace octetra::verify::exact
