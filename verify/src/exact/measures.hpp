#pragma once

#include <array>
#include <memory>
#include <string>

#include <octetra/core/point.hpp>

/// Volumes and areas without rounding.
namespace octetra::verify::exact {

/// A sum of volumes of tetrahedra, taken six times. Exact; it holds a number of any length.
class VolumeSum {
public:
    VolumeSum();
    ~VolumeSum();
    VolumeSum(const VolumeSum&) = delete;
    VolumeSum& operator=(const VolumeSum&) = delete;
    VolumeSum(VolumeSum&&) = delete;
    VolumeSum& operator=(VolumeSum&&) = delete;

    void clear();
    /// Adds the signed volume.
    void add(const std::array<Point, 4>& corners);
    void subtract(const std::array<Point, 4>& corners);
    /// Is it between -bound and bound? (Zero, for a bound of zero.) Of the bound, the 53 leading
    /// bits count.
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] double rounded() const;
    /// As text that NumberSum takes.
    [[nodiscard]] std::string exactly() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A sum of floating-point numbers. Exact; of each, the 53 leading bits count.
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
    /// Adds or subtracts a sum as exactly() has told it, here or in another process.
    void add_exactly(const std::string& sum);
    void subtract_exactly(const std::string& sum);
    /// The sum, to within a unit of 2^-52 of it; also where that is no number for a double.
    [[nodiscard]] long double magnitude() const;
    [[nodiscard]] std::string exactly() const;
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] double rounded() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A sum of vector areas of triangles, (b - a) x (c - a), taken so. Exact.
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
    /// Is every component between -bound and bound? (As of volumes.)
    [[nodiscard]] bool is_within(long double bound) const;
    [[nodiscard]] Point rounded() const;
    /// The length of the sum as a vector, to within some units of 2^-52 of it.
    [[nodiscard]] long double magnitude() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace octetra::verify::exact
