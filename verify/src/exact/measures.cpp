#include "exact/measures.hpp"

#include <gmp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "exact/fixed_point.hpp"

namespace octetra::verify::exact {
namespace {

/// An arbitrary-precision integer times a power of two. Uses GMP directly to reuse memory, because
/// a million volumes are computed per second.
class Dyadic {
public:
    Dyadic() { mpz_init(mantissa_); }
    ~Dyadic() { mpz_clear(mantissa_); }
    Dyadic(const Dyadic&) = delete;
    Dyadic& operator=(const Dyadic&) = delete;
    Dyadic(Dyadic&&) = delete;
    Dyadic& operator=(Dyadic&&) = delete;

    /// Sets the value, rounded to the precision of a double.
    template <class Float>
    void set(Float value) {
        constexpr int bits = 53;
        int exponent = 0;
        const Float fraction = std::frexp(value, &exponent);
        mpz_set_d(mantissa_, static_cast<double>(std::ldexp(fraction, bits)));
        exponent_ = value == 0 ? 0 : exponent - bits;
    }
    /// Sets an integer in two's complement, times a power of two.
    void set(DeterminantSum::Limbs limbs, int exponent) {
        const bool negative = limbs.back() >> 63U != 0;
        std::uint64_t carry = 1;
        for (std::uint64_t& limb : limbs) {
            if (!negative) break;
            limb = ~limb + carry;
            carry = carry != 0 && limb == 0 ? 1 : 0;
        }
        mpz_import(mantissa_, limbs.size(), -1, sizeof(limbs[0]), 0, 0, limbs.data());
        if (negative) mpz_neg(mantissa_, mantissa_);
        exponent_ = exponent;
    }
    void set_sum(const Dyadic& a, const Dyadic& b, Dyadic& scratch) {
        combine(a, b, scratch, mpz_add);
    }
    void set_difference(const Dyadic& a, const Dyadic& b, Dyadic& scratch) {
        combine(a, b, scratch, mpz_sub);
    }
    void set_product(const Dyadic& a, const Dyadic& b) {
        mpz_mul(mantissa_, a.mantissa_, b.mantissa_);
        exponent_ = a.exponent_ + b.exponent_;
    }
    void clear() {
        mpz_set_ui(mantissa_, 0);
        exponent_ = 0;
    }
    /// Returns "MANTISSA*2^EXPONENT", with the mantissa in hexadecimal.
    [[nodiscard]] std::string text() const {
        std::string digits(mpz_sizeinbase(mantissa_, base) + 2, '\0');
        mpz_get_str(digits.data(), base, mantissa_);
        digits.resize(digits.find('\0'));
        return digits + separator + std::to_string(exponent_);
    }
    void set_text(const std::string& text) {
        const std::size_t end = text.find(separator);
        if (mpz_set_str(mantissa_, text.substr(0, end).c_str(), base) != 0) {
            throw std::logic_error("not the text of a sum: " + text);
        }
        exponent_ = std::stol(text.substr(end + separator.size()));
    }
    [[nodiscard]] int sign() const { return mpz_sgn(mantissa_); }
    template <class Float = double>
    [[nodiscard]] Float rounded() const {
        long exponent = 0;
        const Float fraction = mpz_get_d_2exp(&exponent, mantissa_);
        return std::ldexp(fraction, static_cast<int>(exponent + exponent_));
    }

private:
    void combine(const Dyadic& a, const Dyadic& b, Dyadic& scratch,
                 void (*operation)(mpz_ptr, mpz_srcptr, mpz_srcptr)) {
        if (a.exponent_ == b.exponent_) {
            exponent_ = a.exponent_;
            operation(mantissa_, a.mantissa_, b.mantissa_);
        } else if (a.exponent_ > b.exponent_) {
            mpz_mul_2exp(scratch.mantissa_, a.mantissa_, shift(a, b));
            exponent_ = b.exponent_;
            operation(mantissa_, scratch.mantissa_, b.mantissa_);
        } else {
            mpz_mul_2exp(scratch.mantissa_, b.mantissa_, shift(b, a));
            exponent_ = a.exponent_;
            operation(mantissa_, a.mantissa_, scratch.mantissa_);
        }
    }
    static mp_bitcnt_t shift(const Dyadic& high, const Dyadic& low) {
        return static_cast<mp_bitcnt_t>(high.exponent_ - low.exponent_);
    }

    static constexpr int base = 16;
    inline static const std::string separator = "*2^";

    mpz_t mantissa_{};
    long exponent_ = 0;
};

using Vector = std::array<Dyadic, 3>;

void set(Vector& v, const Point& p) {
    v[0].set(p.x);
    v[1].set(p.y);
    v[2].set(p.z);
}

/// Returns whether |sum| <= bound.
bool within(const Dyadic& sum, long double bound, Dyadic& scratch, Dyadic& difference) {
    if (sum.sign() == 0) return true;
    if (bound == 0) return false;
    Dyadic limit;
    limit.set(sum.sign() > 0 ? bound : -bound);
    difference.set_difference(sum, limit, scratch);
    return difference.sign() * sum.sign() <= 0;
}

/// The cross product of two edges of a triangle.
struct CrossProduct {
    Vector a, b, c, u, v, result;
    Dyadic left, right, scratch;

    void compute(const std::array<Point, 3>& corners) {
        set(a, corners[0]);
        set(b, corners[1]);
        set(c, corners[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            u[k].set_difference(b[k], a[k], scratch);
            v[k].set_difference(c[k], a[k], scratch);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            left.set_product(u[(k + 1) % 3], v[(k + 2) % 3]);
            right.set_product(u[(k + 2) % 3], v[(k + 1) % 3]);
            result[k].set_difference(left, right, scratch);
        }
    }
};

}  // namespace

double largest_coordinate(std::span<const Point> points) {
    double largest = 0;
    for (const Point& p : points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

struct VolumeSum::State {
    CrossProduct base;
    Vector apex;
    Dyadic edge, term, volume, sum, scratch, difference;
    Grid grid;
    DeterminantSum on_grid;  ///< to be added to `sum`

    void compute(const std::array<Point, 4>& p) {
        base.compute({p[0], p[1], p[2]});
        set(apex, p[3]);
        volume.clear();
        for (std::size_t k = 0; k < 3; ++k) {
            edge.set_difference(apex[k], base.a[k], scratch);
            term.set_product(edge, base.result[k]);
            volume.set_sum(volume, term, scratch);
        }
    }

    /// Returns false if the corners are not on the grid.
    bool add_on_grid(const std::array<Point, 4>& p, int sign) {
        std::array<DeterminantSum::Corner, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            if (!grid.convert(p[k], corners[k])) return false;
        }
        on_grid.add(corners[0], corners[1], corners[2], corners[3], sign);
        return true;
    }

    /// Returns the whole sum.
    const Dyadic& total() {
        if (!on_grid.is_zero()) {
            term.set(on_grid.limbs(), -3 * grid.shift());
            sum.set_sum(sum, term, scratch);
            on_grid.clear();
        }
        return sum;
    }
};

VolumeSum::VolumeSum() : state_(std::make_unique<State>()) {}
VolumeSum::~VolumeSum() = default;

void VolumeSum::clear(double largest) {
    state_->sum.clear();
    state_->on_grid.clear();
    state_->grid = Grid(largest);
}

void VolumeSum::add(const std::array<Point, 4>& corners) {
    if (state_->add_on_grid(corners, 1)) return;
    state_->compute(corners);
    state_->sum.set_sum(state_->sum, state_->volume, state_->scratch);
}

void VolumeSum::subtract(const std::array<Point, 4>& corners) {
    if (state_->add_on_grid(corners, -1)) return;
    state_->compute(corners);
    state_->sum.set_difference(state_->sum, state_->volume, state_->scratch);
}

bool VolumeSum::is_within(long double bound) const {
    return within(state_->total(), bound, state_->scratch, state_->difference);
}

double VolumeSum::rounded() const { return state_->total().rounded(); }

std::string VolumeSum::exactly() const { return state_->total().text(); }

struct NumberSum::State {
    Dyadic sum, number, scratch, difference;
};

NumberSum::NumberSum() : state_(std::make_unique<State>()) {}
NumberSum::~NumberSum() = default;

void NumberSum::clear() { state_->sum.clear(); }

void NumberSum::add(long double number) {
    state_->number.set(number);
    state_->sum.set_sum(state_->sum, state_->number, state_->scratch);
}

bool NumberSum::is_within(long double bound) const {
    return within(state_->sum, bound, state_->scratch, state_->difference);
}

double NumberSum::rounded() const { return state_->sum.rounded(); }

void NumberSum::add_exactly(const std::string& sum) {
    state_->number.set_text(sum);
    state_->sum.set_sum(state_->sum, state_->number, state_->scratch);
}

void NumberSum::subtract_exactly(const std::string& sum) {
    state_->number.set_text(sum);
    state_->sum.set_difference(state_->sum, state_->number, state_->scratch);
}

long double NumberSum::magnitude() const { return state_->sum.rounded<long double>(); }

std::string NumberSum::exactly() const { return state_->sum.text(); }

struct AreaSum::State {
    CrossProduct area;
    Vector sum;
    Dyadic scratch, difference;
};

AreaSum::AreaSum() : state_(std::make_unique<State>()) {}
AreaSum::~AreaSum() = default;

void AreaSum::clear() {
    for (Dyadic& component : state_->sum) component.clear();
}

void AreaSum::add(const std::array<Point, 3>& corners) {
    state_->area.compute(corners);
    for (std::size_t k = 0; k < 3; ++k) {
        state_->sum[k].set_sum(state_->sum[k], state_->area.result[k], state_->scratch);
    }
}

void AreaSum::subtract(const std::array<Point, 3>& corners) {
    state_->area.compute(corners);
    for (std::size_t k = 0; k < 3; ++k) {
        state_->sum[k].set_difference(state_->sum[k], state_->area.result[k], state_->scratch);
    }
}

bool AreaSum::is_within(long double bound) const {
    return std::all_of(state_->sum.begin(), state_->sum.end(), [&](const Dyadic& component) {
        return within(component, bound, state_->scratch, state_->difference);
    });
}

Point AreaSum::rounded() const {
    return {state_->sum[0].rounded(), state_->sum[1].rounded(), state_->sum[2].rounded()};
}

long double AreaSum::magnitude() const {
    long double square = 0;
    for (const Dyadic& component : state_->sum) {
        const auto length = component.rounded<long double>();
        square += length * length;
    }
    return std::sqrt(square);
}

}  // namespace octetra::verify::exact
