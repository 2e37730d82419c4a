#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "collective.hpp"

namespace octetra::python {

namespace od = distributed;

/// What keeps the memory of numpy arrays: the mesh while it has them, then what the mesh has left.
struct Memory {
    std::shared_ptr<const void> owner;
};

/// The Mesh of Python: an AdaptiveMesh, and which of its arrays are looked at.
class Mesh : public std::enable_shared_from_this<Mesh> {
public:
    enum Array { points, cells, facets, edges, vertex_numbers, roots, array_count };

    explicit Mesh(od::AdaptiveMesh mesh) : mesh_(std::move(mesh)) {}

    /// To look at. Throws while another thread is in a collective function.
    [[nodiscard]] const od::AdaptiveMesh& now() const {
        if (is_busy_) throw SystemError("the mesh is in use by another thread");
        return mesh_;
    }
    [[nodiscard]] const od::Communicator& processes() const { return mesh_.processes(); }

    [[nodiscard]] std::size_t cell_count() const { return mesh_.cells().size(); }
    [[nodiscard]] std::size_t vertex_count() const { return mesh_.points().size(); }

    /// The memory of one of the mesh's arrays, which lives as long as who has it.
    [[nodiscard]] std::shared_ptr<Memory> hold(Array array);

    /// Collective. Calls a collective function of the mesh that does not change it.
    auto ask(auto&& function) {
        const Busy busy(*this);
        return without_gil([&] { return function(std::as_const(mesh_)); });
    }
    /// Collective. Converts what each rank has passed, leaves arrays that are looked at as they
    /// are, and takes the step.
    auto change(const std::function<void()>& convert, auto&& step) {
        const Busy busy(*this);
        convert_on_each(processes(), [&] {
            convert();
            detach_arrays();
        });
        return without_gil([&] { return step(mesh_); });
    }
    /// Collective. The same of a step that has what is passed converted itself, by a function that
    /// it gets, where all processes hear whether that has failed.
    auto change_when_asked(const std::function<void()>& convert, auto&& step) {
        const Busy busy(*this);
        const auto ask = [&] {
            convert_here(processes(), [&] {
                convert();
                detach_arrays();
            });
        };
        return without_gil([&] { return step(mesh_, ask); });
    }

private:
    /// While one thread is in a collective function others have the GIL.
    class Busy {
    public:
        explicit Busy(Mesh& mesh) : mesh_(&mesh) {
            (void)mesh.now();
            mesh.is_busy_ = true;
        }
        ~Busy() { mesh_->is_busy_ = false; }
        Busy(const Busy&) = delete;
        Busy& operator=(const Busy&) = delete;
        Busy(Busy&&) = delete;
        Busy& operator=(Busy&&) = delete;

    private:
        Mesh* mesh_;
    };

    void detach_arrays();

    od::AdaptiveMesh mesh_;
    std::array<std::weak_ptr<Memory>, array_count> held_;
    bool is_busy_ = false;
};

using MeshPointer = std::shared_ptr<Mesh>;

}  // namespace octetra::python
