#pragma once

namespace springlod::app {

/// Lets the sums of large products be split in the same way on every processor, whatever its
/// caches. Merging and steps then have the same bits on all of them.
void fix_block_sizes();

/// Lets OpenBLAS use its kernels for AVX2 on every processor that has AVX2, so that fits and modes
/// have the same bits on all of them: those for AVX-512 round differently. Starts the program again
/// if OpenBLAS has chosen others, because it chooses when it is loaded. A choice of the user, the
/// environment variable OPENBLAS_CORETYPE, stays.
void fix_blas_kernels(char** argv);

/// Limits the kernels of steps to SSE4, and starts the program again if its libraries would choose
/// instructions by the processor: OpenBLAS in fits and modes, the C library in functions such as
/// sin and exp. Afterwards all results have the same bits on every x86-64 processor with SSE4.2.
/// Returns in the program that was started.
/// Throws InputError if the processor has no SSE4.2, IoError if the program cannot be started.
void make_portable(char** argv);

}  // namespace springlod::app
