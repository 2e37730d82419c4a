# One folder of the house, one library: its public headers under include/octetra/<name>/ are its only
# include root that others see, so a layer can include no other layer than those that it links.

set(CMAKE_CXX_EXTENSIONS OFF)

function(octetra_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wsign-conversion -Wold-style-cast
                                           # {.radius = 1} leaves the rest at their defaults
                                           -Wno-missing-field-initializers
                                           # A fused multiply-add would round squared lengths, and the
                                           # order of edges, otherwise in one place than in another.
                                           -ffp-contract=off)
  if(CMAKE_UNITY_BUILD)  # a file hides by its names what those before it have
    target_compile_options(${target} PRIVATE -Wno-shadow
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # as below
  endif()
  if(OCTETRA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# octetra_layer(<name> [STATIC] SOURCES <file>... HEADERS <file>... [HEADERS_APART <file>...]
#               [LAYER_HEADERS <file>...] [LINKS <target>...] [USES <target>...])
# HEADERS are all that there are under include/, but for HEADERS_APART, which the caller installs.
# LAYER_HEADERS, under layers/, are for other layers and not for users; they ask for the options of
# octetra_compile_options. LINKS are part of the layer's interface, USES are not. BUILD_SHARED_LIBS
# decides what kind of library it is; a static one can be linked into a shared one, too. STATIC is a layer
# that is not installed, whatever the others are: the installed program has it in itself.
function(octetra_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "STATIC" "" "SOURCES;HEADERS;HEADERS_APART;LAYER_HEADERS;LINKS;USES")
  file(GLOB_RECURSE headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS include/*.hpp)
  list(REMOVE_ITEM headers ${layer_HEADERS} ${layer_HEADERS_APART})
  if(headers)
    message(FATAL_ERROR "not among the HEADERS of ${name}, so not installed: ${headers}")
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
  # Half of the time is that of parsing headers. Few at a time, so that one that was changed is soon
  # compiled again.
  if(OCTETRA_UNITY AND NOT CMAKE_UNITY_BUILD)
    set_target_properties(octetra_${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
    # g++ takes a file that is compiled with others for a header, in which a type of no name would be a mistake.
    target_compile_options(octetra_${name} PRIVATE
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  # Nobody replaces our functions by others of their name, so they may be inlined in a shared library.
  target_compile_options(octetra_${name} PRIVATE
                         $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
endfunction()
