#pragma once

#include <utility>
#include <vector>

#include <octetra/distributed/communicator.hpp>
#include <octetra/verify/group.hpp>

namespace octetra::cli {

/// The processes of a communicator, as the verifier knows them.
class Judges final : public verify::Group {
public:
    explicit Judges(distributed::Communicator processes) : processes_(std::move(processes)) {}

    [[nodiscard]] int rank() const override { return processes_.rank(); }
    [[nodiscard]] int size() const override { return processes_.size(); }
    [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> to_each) const override {
        return processes_.all_to_all(to_each);
    }

private:
    distributed::Communicator processes_;
};

}  // namespace octetra::cli
