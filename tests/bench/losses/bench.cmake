find_package(embree 3.13 REQUIRED)
farcell_program(tests/bench/losses bench_losses DEPS farcell_runtime farcell_tools_evaluate_reference
                farcell_tools_evaluate_metrics farcell_tools_evaluate_plan embree)
