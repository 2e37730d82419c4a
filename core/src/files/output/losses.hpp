#pragma once

#include <string>
#include <string_view>

/// Messages on data that a format cannot represent.
namespace octetra {

/// Appends a loss to a message.
inline void add_loss(std::string& lost, std::string_view loss) {
    if (loss.empty()) return;
    lost += lost.empty() ? "" : "; ";
    lost += loss;
}

inline constexpr std::string_view group_names_are_lost =
    "the names of groups are lost; .msh and .octetra files hold them";

inline constexpr std::string_view features_are_lost =
    "corners, ridges and required entities are lost; .mesh, .meshb and .octetra files hold them";

}  // namespace octetra
