#pragma once

#include <octetra/core/mesh_source.hpp>
#include <octetra/distributed/communicator.hpp>

namespace octetra::distributed {

/// The processes of a communicator, as core's writers know them.
class ProcessGroup final : public WriterGroup {
public:
    explicit ProcessGroup(Communicator processes) : processes_(std::move(processes)) {}

    [[nodiscard]] int rank() const override { return processes_.rank(); }
    [[nodiscard]] int size() const override { return processes_.size(); }
    [[nodiscard]] Share share_of(std::uint64_t number) const override;
    [[nodiscard]] std::uint64_t of_first(std::uint64_t number) const override;
    void on_first(const std::function<void()>& work) const override;
    void agree(const std::string& failure) const override;

private:
    Communicator processes_;
};

}  // namespace octetra::distributed
