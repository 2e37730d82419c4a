#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include <octetra/core/point.hpp>

/// Exact volumes and areas.
namespace octetra::verify::exact {

/// Returns the largest size of a coordinate.
[[nodiscard]] double largest_coordinate(std::span<const Point> points);

/// A sum of volumes of tetrahedra, times six, in exact arithmetic of arbitrary precision.
class VolumeSum {
public:
    VolumeSum();
    ~VolumeSum();
    VolumeSum(const VolumeSum&) = delete;
    VolumeSum& operator=(const VolumeSum&) = delete;
    VolumeSum(VolumeSum&&) = delete;
    VolumeSum& operator=(VolumeSum&&) = delete;

    /// `largest` is the largest size of the coordinates to be added. Any other value makes the sum
    /// slower, not wrong.
    void clear(double largest = 0);
    /// Adds the signed volume.
    void add(const std::array<Point, 4>& corners);
    void subtract(const std::array<Point, 4>& corners);
    /// Returns whether the sum is between -bound and bound (zero, for a bound of zero). The 53
    /// leading bits of the bound are used.
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] double rounded() const;
    /// Returns the sum as text that NumberSum accepts.
    [[nodiscard]] std::string exactly() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// An exact sum of floating-point numbers, of each of which the 53 leading bits are used.
class NumberSum {
public:
    NumberSum();
    ~NumberSum();
    NumberSum(const NumberSum&) = delete;
    NumberSum& operator=(const NumberSum&) = delete;
    NumberSum(NumberSum&&) = delete;
    NumberSum& operator=(NumberSum&&) = delete;

    void clear();
    void add(long double number);
    /// Adds or subtracts a sum in the format of exactly(), from this or another process.
    void add_exactly(const std::string& sum);
    void subtract_exactly(const std::string& sum);
    /// Returns the sum to within a relative error of 2^-52, also if it exceeds the range of a
    /// double.
    [[nodiscard]] long double magnitude() const;
    [[nodiscard]] std::string exactly() const;
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] double rounded() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// An exact sum of vector areas of triangles, as cross products (b - a) x (c - a).
class AreaSum {
public:
    AreaSum();
    ~AreaSum();
    AreaSum(const AreaSum&) = delete;
    AreaSum& operator=(const AreaSum&) = delete;
    AreaSum(AreaSum&&) = delete;
    AreaSum& operator=(AreaSum&&) = delete;

    void clear();
    void add(const std::array<Point, 3>& corners);
    void subtract(const std::array<Point, 3>& corners);
    /// Returns whether every component is between -bound and bound; see VolumeSum.
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] Point rounded() const;
    /// Returns the length of the sum as a vector, to within a relative error of some 2^-52.
    [[nodiscard]] long double magnitude() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace octetra::verify::exact
