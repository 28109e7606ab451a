add_executable(bench_codec ${CMAKE_CURRENT_SOURCE_DIR}/codec/codec.cpp)
target_link_libraries(bench_codec PRIVATE farcell_settings farcell_cache_pack)
