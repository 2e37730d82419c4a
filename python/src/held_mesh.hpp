#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>

#include "arguments.hpp"
#include "collective.hpp"

namespace octetra::python {

namespace od = distributed;

/// The owner of the memory of numpy arrays: the mesh, until a step detaches arrays in use.
struct Memory {
    std::shared_ptr<const void> owner;
};

/// The class Mesh of Python: an AdaptiveMesh, and which of its arrays numpy arrays refer to.
class Mesh : public std::enable_shared_from_this<Mesh> {
public:
    enum Array { points, cells, facets, edges, vertex_numbers, roots, array_count };

    explicit Mesh(od::AdaptiveMesh mesh) : mesh_(std::move(mesh)) {}

    /// The mesh, to read. Throws while another thread is in a collective function.
    [[nodiscard]] const od::AdaptiveMesh& now() const {
        if (is_busy_) throw SystemError("the mesh is in use by another thread");
        return mesh_;
    }
    [[nodiscard]] const od::Communicator& processes() const { return mesh_.processes(); }

    [[nodiscard]] std::size_t cell_count() const { return mesh_.cells().size(); }
    [[nodiscard]] std::size_t vertex_count() const { return mesh_.points().size(); }

    /// The owner of the memory of one array, for a numpy array to keep alive.
    [[nodiscard]] std::shared_ptr<Memory> hold(Array array);

    /// Collective. Calls a collective function of the mesh that does not change it.
    auto ask(auto&& function) {
        const Busy busy(*this);
        return without_gil([&] { return function(std::as_const(mesh_)); });
    }
    /// Collective. The same for a function of Python without parameters but the mesh: refuses the
    /// arguments on all ranks if one rank passes others.
    auto ask(const Arguments& arguments, auto&& function) {
        const Busy busy(*this);
        convert_on_each(processes(), [&] { arguments.check(); });
        return without_gil([&] { return function(std::as_const(mesh_)); });
    }
    /// Collective. Converts the arguments of each rank, detaches arrays in use, and then calls
    /// `step`, which changes the mesh.
    auto change(const std::function<void()>& convert, auto&& step) {
        const Busy busy(*this);
        convert_on_each(processes(), [&] {
            convert();
            detach_arrays();
        });
        return without_gil([&] { return step(mesh_); });
    }
    /// Collective. The same for a step that agrees on failures itself: `step` gets a function that
    /// converts the arguments of this rank, and calls it where an exception reaches all ranks.
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
    /// Marks the mesh as in use: while one thread is in a collective function, others may run.
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

    /// Detaches the arrays to which numpy arrays refer, which keep them as they are.
    void detach_arrays();

    od::AdaptiveMesh mesh_;
    std::array<std::weak_ptr<Memory>, array_count> held_;
    bool is_busy_ = false;
};

using MeshPointer = std::shared_ptr<Mesh>;

}  // namespace octetra::python
