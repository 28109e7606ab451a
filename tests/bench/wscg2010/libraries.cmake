# The parts of bench_wscg2010, which its test links too: whichever of the two is configured first makes them.
if(TARGET farcell_tests_bench_wscg2010_scene)
  return()
endif()
find_package(embree 3.13 REQUIRED)
pkg_check_modules(webp REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(lzma REQUIRED IMPORTED_TARGET liblzma)
find_package(ZLIB REQUIRED)

file(GLOB wscg2010_shaders CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_LIST_DIR}/shaders/*)
farcell_embed(farcell_tests_bench_wscg2010_shaders HEADER tests/bench/wscg2010/draw/shader_files.h
              FUNCTION wscg::shaderText FILES ${wscg2010_shaders})
farcell_library(tests/bench/wscg2010/scene DEPS farcell_preprocess_bake farcell_runtime_camera
                                           PRIVATE farcell_preprocess_read)
farcell_library(tests/bench/wscg2010/draw DEPS farcell_tests_bench_wscg2010_scene farcell_runtime
                                          PRIVATE farcell_tests_bench_wscg2010_shaders)
farcell_library(tests/bench/wscg2010/measure
                DEPS farcell_tests_bench_wscg2010_draw farcell_tools_evaluate_reference farcell_tools_image
                PRIVATE PkgConfig::webp PkgConfig::lzma ZLIB::ZLIB
                APART errors.cpp image_store.cpp coders.cpp references.cpp)
