farcell_program(tests/bench/cut bench_cut DEPS farcell_runtime farcell_tools_evaluate_reference farcell_tools_evaluate_metrics
                farcell_tools_evaluate_plan)
