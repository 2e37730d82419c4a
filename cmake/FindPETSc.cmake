# PETSc::PETSc: the library, found with pkg-config (Debian: libpetsc-real-dev). Only include and
# library folders are used, not the compiler flags of its build. Headers are system headers, so that
# warnings in them do not fail the build.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PETSC_PKG QUIET PETSc)
endif()
set(PETSc_VERSION ${PETSC_PKG_VERSION})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(PETSc REQUIRED_VARS PETSC_PKG_LINK_LIBRARIES PETSC_PKG_INCLUDE_DIRS
                                  VERSION_VAR PETSc_VERSION)
if(PETSc_FOUND AND NOT TARGET PETSc::PETSc)
  add_library(PETSc::PETSc INTERFACE IMPORTED)
  target_include_directories(PETSc::PETSc SYSTEM INTERFACE ${PETSC_PKG_INCLUDE_DIRS})
  target_link_libraries(PETSc::PETSc INTERFACE ${PETSC_PKG_LINK_LIBRARIES})
endif()
