#include "grouped.hpp"

namespace octetra::cli {

std::string grouped(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, 1, ',');
    return text;
}

}  // namespace octetra::cli
