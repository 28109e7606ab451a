find_package(CLI11 REQUIRED)
add_executable(bench_choose ${CMAKE_CURRENT_SOURCE_DIR}/choose/main.cpp)
target_link_libraries(bench_choose PRIVATE farcell_settings farcell_preprocess_choose CLI11::CLI11)
