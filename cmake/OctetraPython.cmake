# Dependencies and installation folder of the Python module: sets OCTETRA_PYTHON_FOUND and
# octetra_module_dir. Missing dependencies are reported in CMake's output; for a wheel, which
# scikit-build-core builds with SKBUILD defined, they are an error.

# Uses the system's interpreter, whose packages are listed in packages.txt, unless
# -DPython_EXECUTABLE is given.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
if(Python_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
set(OCTETRA_PYTHON_FOUND OFF)
set(kind STATUS)
if(SKBUILD)
  set(kind FATAL_ERROR)
endif()
if(Python_FOUND AND pybind11_FOUND)
  set(OCTETRA_PYTHON_FOUND ON)
  execute_process(COMMAND ${Python_EXECUTABLE} -c "import sysconfig; print(sysconfig.get_path('platlib'))"
                  OUTPUT_VARIABLE site OUTPUT_STRIP_TRAILING_WHITESPACE)
  cmake_path(GET site FILENAME site)  # dist-packages on Debian, site-packages elsewhere
  set(OCTETRA_PYTHON_SITE lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/${site}
      CACHE STRING "Where the Python module is installed, below the prefix")
  cmake_path(SET octetra_module_dir NORMALIZE ${OCTETRA_PYTHON_SITE}/octetra)
  message(STATUS "Python module: for ${Python_EXECUTABLE} (${Python_VERSION})")
elseif(Python_FOUND)
  message(${kind} "Python module: not built, because pybind11 was not found (Debian: pybind11-dev)")
else()
  message(${kind} "Python module: not built, because the development files of Python were not found "
                  "(Debian: python3-dev)")
endif()

# octetra_python_extension(<target> <name> SOURCES ... LINKS ... FILES ...): a compiled part of the
# module next to octetra_python, for an adapter, with Python files from the caller's folder.
function(octetra_python_extension target name)
  cmake_parse_arguments(extension "" "" "SOURCES;LINKS;FILES" ${ARGN})
  pybind11_add_module(${target} MODULE NO_EXTRAS ${extension_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/python/src)
  target_link_libraries(${target} PRIVATE ${extension_LINKS} fmt::fmt)
  octetra_compile_options(${target})
  get_target_property(run_path octetra_python INSTALL_RPATH)
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/octetra
    CXX_VISIBILITY_PRESET hidden INSTALL_RPATH "${run_path}")
  install(TARGETS ${target} LIBRARY DESTINATION ${octetra_module_dir} COMPONENT python)
  octetra_python_files(octetra ${extension_FILES})
endfunction()

# octetra_python_files(<package> <file>...): files of a package of the module, in the build tree and installed.
function(octetra_python_files package)
  cmake_path(SET folder NORMALIZE ${OCTETRA_PYTHON_SITE}/${package})
  foreach(file IN LISTS ARGN)
    cmake_path(GET file FILENAME file_name)
    configure_file(${file} ${PROJECT_BINARY_DIR}/python/${package}/${file_name} COPYONLY)
    install(FILES ${file} DESTINATION ${folder} COMPONENT python)
  endforeach()
endfunction()
