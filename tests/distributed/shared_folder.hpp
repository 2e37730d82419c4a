#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "distributed/world.hpp"
#include "support/temporary_folder.hpp"

namespace octetra::test {

/// Collective. A temporary folder of the first process, whose path all processes have.
class SharedFolder {
public:
    SharedFolder() {
        if (world().is_first()) own_ = std::make_unique<test::TemporaryFolder>();
        std::vector<char> name;
        if (own_) {
            const std::string path = own_->path().native();
            name.assign(path.begin(), path.end());
        }
        world().broadcast(name);
        path_ = std::string(name.begin(), name.end());
    }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }

private:
    std::unique_ptr<test::TemporaryFolder> own_;
    std::filesystem::path path_;
};

}  // namespace octetra::test
