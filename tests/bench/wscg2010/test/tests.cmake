include(${CMAKE_CURRENT_LIST_DIR}/../libraries.cmake)
farcell_tests(bench/wscg2010/test DEPS farcell_tests_bench_wscg2010_measure)
