#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/files/series.hpp>

#include "collective.hpp"

namespace octetra::python {

/// The class MeshSeries of Python: a series, until it is committed or discarded, and its
/// communicator.
class Series {
public:
    Series(distributed::Communicator processes, const std::filesystem::path& path)
        : processes_(std::move(processes)), open_(std::in_place, path, processes_) {}

    [[nodiscard]] const distributed::Communicator& processes() const { return processes_; }
    [[nodiscard]] bool is_open() const { return open_.has_value(); }
    /// Discards what has been written. Not collective.
    void give_up() {
        if (is_lent_) throw SystemError("the series is in use by another thread");
        open_.reset();
    }

    /// Access for one thread in a collective function, during which other threads may run.
    class Lent {
    public:
        explicit Lent(Series& series) : series_(&series) {
            if (series.is_lent_) throw SystemError("the series is in use by another thread");
            if (!series.open_) throw InputError("the series has been committed or discarded");
            series.is_lent_ = true;
        }
        ~Lent() { series_->is_lent_ = false; }
        Lent(const Lent&) = delete;
        Lent& operator=(const Lent&) = delete;
        Lent(Lent&&) = delete;
        Lent& operator=(Lent&&) = delete;

        [[nodiscard]] MeshSeries& operator*() const { return *series_->open_; }

    private:
        Series* series_;
    };

private:
    distributed::Communicator processes_;
    std::optional<MeshSeries> open_;
    bool is_lent_ = false;
};

}  // namespace octetra::python
