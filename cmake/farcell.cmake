# How every target of farcell is made. A directory is a target: farcell_library(cache/base) makes
# farcell_cache_base from all .cpp files of cache/base. Includes are written from the repository root.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

add_library(farcell_settings INTERFACE)
target_include_directories(farcell_settings INTERFACE ${CMAKE_SOURCE_DIR})
# -ffp-contract=off: the same source gives the same bits on every machine; where a fused multiply-add
# is wanted it is written out (hwy::MulAdd, std::fma).
target_compile_options(farcell_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                                  -Wno-sign-conversion -ffp-contract=off)
target_compile_definitions(farcell_settings INTERFACE GLM_FORCE_EXPLICIT_CTOR GLM_FORCE_XYZW_ONLY
                                                      FARCELL_VERSION="${PROJECT_VERSION}")
target_link_libraries(farcell_settings INTERFACE Threads::Threads)
# Sanitizers make GCC see what is not there (-Wmaybe-uninitialized, -Wrestrict): there, warnings stay warnings.
if(FARCELL_WERROR AND NOT FARCELL_SANITIZE)
  target_compile_options(farcell_settings INTERFACE -Werror)
endif()
# Anonymous namespaces of files that another includes are taken for those of headers; and with so much in sight GCC 12
# sees what is not there, as with sanitizers.
if(FARCELL_UNITY)
  target_compile_options(farcell_settings INTERFACE
    -Wno-subobject-linkage -Wno-error=array-bounds -Wno-error=dangling-pointer -Wno-error=maybe-uninitialized
    -Wno-error=restrict -Wno-error=stringop-overflow -Wno-error=stringop-overread)
endif()
if(FARCELL_SANITIZE)
  add_compile_options(-fsanitize=${FARCELL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${FARCELL_SANITIZE})
  # Of Highway's six instruction sets for x86 the least and the usual one; the release build has them all.
  target_compile_definitions(farcell_settings INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
endif()

# With FARCELL_UNITY (CI, most of whose time builds would take) the files of a target are compiled a few at a time as
# one. So no two files of a directory should have a name in common, in anonymous namespaces too; those that do are named
# after APART and compiled alone, as are Highway's files, which include themselves.
function(farcell_unity target directory)
  set_target_properties(${target} PROPERTIES UNITY_BUILD "${FARCELL_UNITY}")
  list(TRANSFORM ARGN PREPEND ${CMAKE_SOURCE_DIR}/${directory}/ OUTPUT_VARIABLE apart)
  set_source_files_properties(${apart} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# farcell_library(<directory> [DEPS <public libraries>...] [PRIVATE <private libraries>...] [APART <files>...])
function(farcell_library directory)
  cmake_parse_arguments(ARG "" "" "DEPS;PRIVATE;APART" ${ARGN})
  string(REPLACE "/" "_" name "farcell_${directory}")
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${directory}/*.cpp)
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC farcell_settings ${ARG_DEPS} PRIVATE ${ARG_PRIVATE})
    farcell_unity(${name} ${directory} ${ARG_APART})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE farcell_settings ${ARG_DEPS})
  endif()
endfunction()

# farcell_program(<directory> <name> [DEPS <libraries>...]). Those below tools/ are what farcell is for its users: the
# global property FARCELL_PROGRAMS lists them, they are installed, and have manual pages and completion (cmake/reference.cmake).
function(farcell_program directory name)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${directory}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE farcell_settings ${ARG_DEPS})
  farcell_unity(${name} ${directory})
  if(directory MATCHES "^tools/")
    set_property(GLOBAL APPEND PROPERTY FARCELL_PROGRAMS ${name})
  endif()
endfunction()

# farcell_embed(<library> HEADER <header> FUNCTION <name> FILES <paths from the repository root>...): a library of the
# function, declared in the header, that gives the text of each file: it travels inside the program.
function(farcell_embed library)
  cmake_parse_arguments(ARG "" "HEADER;FUNCTION" "FILES" ${ARGN})
  list(TRANSFORM ARG_FILES PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
  set(embedded ${CMAKE_CURRENT_BINARY_DIR}/${library}.cpp)
  set(script ${CMAKE_SOURCE_DIR}/cmake/embed.cmake)
  add_custom_command(
    OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR} -DOUTPUT=${embedded} -DHEADER=${ARG_HEADER}
            -DFUNCTION=${ARG_FUNCTION} "-DFILES=${ARG_FILES}" -P ${script}
    DEPENDS ${paths} ${script}
    VERBATIM)
  add_library(${library} STATIC ${embedded})
  target_link_libraries(${library} PUBLIC farcell_settings)
endfunction()
