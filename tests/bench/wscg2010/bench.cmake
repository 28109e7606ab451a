include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
farcell_program(tests/bench/wscg2010 bench_wscg2010 DEPS farcell_tests_bench_wscg2010_measure farcell_tools_cli)
