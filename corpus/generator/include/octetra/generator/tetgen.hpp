#pragma once

namespace octetra::generator {

/// Returns whether this build includes TetGen. Without it only lattices can be generated.
[[nodiscard]] bool has_tetgen();

}  // namespace octetra::generator
