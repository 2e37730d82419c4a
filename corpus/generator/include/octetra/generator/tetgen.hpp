#pragma once

namespace octetra::generator {

/// Was this built with TetGen? Without it only the lattices can be made.
[[nodiscard]] bool has_tetgen();

}  // namespace octetra::generator
