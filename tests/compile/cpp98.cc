// The header in C++98, inside and outside of namespaces; also with -Wold-style-cast off: C casts are C++ too.
#include "tribox.h"

#include <cstdio>

#include "every_function.h"

namespace user {

struct Triangle {
    tribox_tri prepared;
    Triangle(const float *v0, const float *v1, const float *v2, const float *size)
    {
        tribox_tri_init(&prepared, v0, v1, v2, size, TRIBOX_HALF_OPEN | TRIBOX_THIN);
    }
};

} // namespace user

int main()
{
    const float zero[3] = {0, 0, 0};
    const float one[3] = {1, 1, 1};
    user::Triangle triangle(zero, one, one, one);
    const int wrong = every_function() + (tribox_tri_test(&triangle.prepared, zero) != 1);

    std::printf("test_cpp: %d passed, %d failed\n", wrong == 0, wrong != 0);
    return wrong != 0;
}
