# DOLFINx::DOLFINx: the finite-element library of FEniCS, with real numbers (Debian: libdolfinx-dev
# and libdolfinx-real-dev). Its own CMake file requires all packages of its build; the information
# of pkg-config is sufficient to compile and link. Only include and library folders are used, not
# the compiler flags of its build.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(DOLFINx_PC QUIET dolfinx_real)
endif()
find_path(DOLFINx_INCLUDE_DIR dolfinx/mesh/Mesh.h HINTS ${DOLFINx_PC_INCLUDE_DIRS})
find_library(DOLFINx_LIBRARY dolfinx_real HINTS ${DOLFINx_PC_LIBRARY_DIRS})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(DOLFINx REQUIRED_VARS DOLFINx_LIBRARY DOLFINx_INCLUDE_DIR DOLFINx_PC_VERSION
                                  VERSION_VAR DOLFINx_PC_VERSION HANDLE_VERSION_RANGE)
if(DOLFINx_FOUND AND NOT TARGET DOLFINx::DOLFINx)
  add_library(DOLFINx::DOLFINx UNKNOWN IMPORTED)
  set_target_properties(DOLFINx::DOLFINx PROPERTIES
    IMPORTED_LOCATION ${DOLFINx_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${DOLFINx_INCLUDE_DIR};${DOLFINx_PC_INCLUDE_DIRS}")
endif()
mark_as_advanced(DOLFINx_INCLUDE_DIR DOLFINx_LIBRARY)
