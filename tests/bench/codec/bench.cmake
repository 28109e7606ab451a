# Coders to compare with.
pkg_check_modules(codec_others REQUIRED IMPORTED_TARGET libwebp libzstd)
add_executable(bench_codec ${CMAKE_CURRENT_SOURCE_DIR}/codec/codec.cpp ${CMAKE_CURRENT_SOURCE_DIR}/codec/coders.cpp
                           ${CMAKE_CURRENT_SOURCE_DIR}/codec/near.cpp
                           ${CMAKE_CURRENT_SOURCE_DIR}/codec/reproject.cpp)
target_link_libraries(bench_codec PRIVATE farcell_settings farcell_cache_pack farcell_preprocess_encode
                                          PkgConfig::codec_others)
