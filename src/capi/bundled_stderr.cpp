// libpng's static library is not made for shared ones: it reads `stderr` as only a program may. The linker
// lets it read this one instead (--wrap=stderr).
#include <cstdio>

extern "C" {
extern FILE* __real_stderr;
FILE* __wrap_stderr = __real_stderr;
}
