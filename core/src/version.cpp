#include <octetra/core/version.hpp>

namespace octetra {

const char* version() { return OCTETRA_VERSION; }

}  // namespace octetra
