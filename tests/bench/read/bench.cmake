add_executable(bench_read ${CMAKE_CURRENT_SOURCE_DIR}/read/main.cpp ${CMAKE_CURRENT_SOURCE_DIR}/read/shuffle.cpp)
target_link_libraries(bench_read PRIVATE farcell_settings farcell_preprocess_read)
