#pragma once

/// Which way a kernel runs. The engine is compiled for SSE4.2; a kernel that has a faster AVX2 form puts it in a
/// file NAME_avx2.cpp (listed with stillwater_avx2() in its room) and calls it where has_avx2() says so. Such a
/// file includes intrinsics and plain C headers only: an inline function of Eigen, OpenCV or std compiled there
/// may be the copy that the linker keeps, and would crash an older CPU.
namespace stillwater {

/// True where the CPU has AVX2, FMA and F16C. The environment variable STILLWATER_CPU=sse4.2 says no (tests,
/// benches).
bool has_avx2();

}  // namespace stillwater
