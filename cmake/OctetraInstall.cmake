# What `cmake --install` puts where. A layer is a component of the package: its library, its headers,
# a file for find_package() and one for pkg-config. Nothing of it tells where it was installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(octetra_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Octetra)

# octetra_install_layer(<name> [REQUIRES <package>...] [PRIVATE_PACKAGES <package>...]
#                       [PRIVATE_LIBRARIES <flag>...])
# Packages as pkg-config names them. REQUIRES are what the interface asks for; what a library uses by
# itself concerns only who links a static one.
function(octetra_install_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "" "" "REQUIRES;PRIVATE_PACKAGES;PRIVATE_LIBRARIES")
  # A shared layer finds those below it beside itself: a program need not name all of them.
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
  set(libraries -loctetra_${name})
  if(NOT BUILD_SHARED_LIBS)
    list(APPEND requires ${layer_PRIVATE_PACKAGES})
    list(APPEND libraries ${layer_PRIVATE_LIBRARIES})
  endif()
  list(JOIN requires " " PC_REQUIRES)
  list(JOIN libraries " " PC_LIBRARIES)
  file(RELATIVE_PATH PC_PREFIX /usr/${CMAKE_INSTALL_LIBDIR}/pkgconfig /usr)
  string(REGEX REPLACE "/$" "" PC_PREFIX ${PC_PREFIX})
  set(PC_NAME ${name})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/octetra.pc.in octetra-${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octetra-${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# Once all layers are known: what find_package(Octetra) reads.
function(octetra_install_package)
  set(OCTETRA_IS_STATIC ON)
  if(BUILD_SHARED_LIBS)
    set(OCTETRA_IS_STATIC OFF)
  endif()
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/OctetraConfig.cmake.in
                                ${PROJECT_BINARY_DIR}/OctetraConfig.cmake
                                INSTALL_DESTINATION ${octetra_package_dir})
  # Before 1.0 a minor version may change what programs see.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/OctetraConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/OctetraConfig.cmake
                ${PROJECT_BINARY_DIR}/OctetraConfigVersion.cmake
                ${PROJECT_SOURCE_DIR}/cmake/FindMETIS.cmake
                ${PROJECT_SOURCE_DIR}/cmake/FindSerialHDF5.cmake
          DESTINATION ${octetra_package_dir})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/octetra)
endfunction()
