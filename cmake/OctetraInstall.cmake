# Installation. A layer is a component of the package: its library, its headers, a file for
# find_package() and one for pkg-config. The files do not contain the installation prefix.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(octetra_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Octetra)

# octetra_install_layer(<name> [REQUIRES <package>...] [CFLAGS <flag>...] [LIBRARIES <flag>...]
#                       [PRIVATE_PACKAGES <package>...] [PRIVATE_LIBRARIES <flag>...])
# Packages have the names of pkg-config. REQUIRES, CFLAGS and LIBRARIES are those of the interface; private packages and
# libraries are relevant only for linking a static library.
function(octetra_install_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "" "" "REQUIRES;CFLAGS;LIBRARIES;PRIVATE_PACKAGES;PRIVATE_LIBRARIES")
  # A shared library finds the layers that it depends on in its own folder, so programs need not
  # list them.
  set(run_path $ORIGIN ${CMAKE_INSTALL_RPATH})
  set_target_properties(octetra_${name} PROPERTIES
    INSTALL_RPATH "${run_path}"
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS octetra_${name} EXPORT Octetra_${name}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT Octetra_${name} NAMESPACE Octetra:: FILE Octetra-${name}.cmake
          DESTINATION ${octetra_package_dir})

  set(requires ${layer_REQUIRES})
  set(libraries -loctetra_${name} ${layer_LIBRARIES})
  if(NOT BUILD_SHARED_LIBS)
    list(APPEND requires ${layer_PRIVATE_PACKAGES})
    list(APPEND libraries ${layer_PRIVATE_LIBRARIES})
  endif()
  list(JOIN requires " " PC_REQUIRES)
  list(JOIN libraries " " PC_LIBRARIES)
  list(PREPEND layer_CFLAGS "-I\${includedir}")
  list(JOIN layer_CFLAGS " " PC_CFLAGS)
  file(RELATIVE_PATH PC_PREFIX /usr/${CMAKE_INSTALL_LIBDIR}/pkgconfig /usr)
  string(REGEX REPLACE "/$" "" PC_PREFIX ${PC_PREFIX})
  set(PC_NAME ${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/octetra.pc.in octetra-${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octetra-${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# Called after all layers have been declared: creates the files read by find_package(Octetra).
function(octetra_install_package)
  set(OCTETRA_IS_STATIC ON)
  if(BUILD_SHARED_LIBS)
    set(OCTETRA_IS_STATIC OFF)
  endif()
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/OctetraConfig.cmake.in
                                ${PROJECT_BINARY_DIR}/OctetraConfig.cmake
                                INSTALL_DESTINATION ${octetra_package_dir})
  # Before 1.0, minor versions may change the interface.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/OctetraConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/OctetraConfig.cmake
                ${PROJECT_BINARY_DIR}/OctetraConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/FindMETIS.cmake
                ${PROJECT_SOURCE_DIR}/cmake/FindSerialHDF5.cmake
          DESTINATION ${octetra_package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/octetra)
endfunction()
