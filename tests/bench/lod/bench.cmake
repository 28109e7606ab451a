find_package(meshoptimizer REQUIRED)
farcell_program(tests/bench/lod bench_lod DEPS farcell_preprocess_lod farcell_preprocess_partition farcell_preprocess_bake
                farcell_preprocess_read meshoptimizer::meshoptimizer)
