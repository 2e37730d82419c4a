# Each layer is a folder and a library: include/octetra/<name>/ contains its public headers and is
# its only include root visible to others, so a layer can include only the layers that it links.

set(CMAKE_CXX_EXTENSIONS OFF)

# octetra_compile_options(<target>): the options that results depend on, and the warnings of the project's own
# build.
function(octetra_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # A fused multiply-add would round squared lengths, and so order edges, differently from place to place.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                             -Wsign-conversion -Wold-style-cast
                                             # {.radius = 1} leaves the other members at their defaults
                                             -Wno-missing-field-initializers)
  endif()
  if(CMAKE_UNITY_BUILD)  # a name may hide one of an earlier file, and g++ treats all but the last file as headers
    target_compile_options(${target} PRIVATE -Wno-shadow
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(OCTETRA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# octetra_layer(<name> [STATIC] SOURCES <file>... HEADERS <file>... [HEADERS_APART <file>...]
#               [LAYER_HEADERS <file>...] [LINKS <target>...] [USES <target>...])
# HEADERS are all headers under include/ except HEADERS_APART, which the caller installs.
# LAYER_HEADERS, under layers/, are for other layers, not for users; they require the options of
# octetra_compile_options. LINKS are part of the layer's interface, USES are not. BUILD_SHARED_LIBS
# determines the kind of library; a static one can also be linked into a shared one. STATIC declares
# a layer that is never installed: it is linked into the installed program.
function(octetra_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "STATIC" "" "SOURCES;HEADERS;HEADERS_APART;LAYER_HEADERS;LINKS;USES")
  file(GLOB_RECURSE headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS include/*.hpp)
  list(REMOVE_ITEM headers ${layer_HEADERS} ${layer_HEADERS_APART})
  if(headers)
    message(FATAL_ERROR "headers missing from HEADERS of ${name}, which would not be installed: ${headers}")
  endif()
  set(kind "")
  if(layer_STATIC)
    set(kind STATIC)
  endif()
  add_library(octetra_${name} ${kind} ${layer_SOURCES})
  add_library(Octetra::${name} ALIAS octetra_${name})
  set_target_properties(octetra_${name} PROPERTIES EXPORT_NAME ${name}
                                                   POSITION_INDEPENDENT_CODE ON
                                                   VERIFY_INTERFACE_HEADER_SETS ON)
  target_sources(octetra_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${layer_HEADERS})
  if(layer_LAYER_HEADERS)
    target_sources(octetra_${name} PRIVATE ${layer_LAYER_HEADERS})
    target_include_directories(octetra_${name} PUBLIC
                               $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/layers>)
  endif()
  target_include_directories(octetra_${name} PRIVATE src)
  target_link_libraries(octetra_${name} PUBLIC ${layer_LINKS} PRIVATE ${layer_USES})
  octetra_compile_options(octetra_${name})
  # Interposition of functions is not supported, so functions can be inlined in a shared library.
  target_compile_options(octetra_${name} PRIVATE
                         $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
endfunction()
