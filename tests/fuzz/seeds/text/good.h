#ifndef A
/* width 1, height 1, layers 1, channels 2 */
static const float a[2] = {1.0f, -2e-5f};
x b[1][4] = {{1, 2, 3, 4}};
#endif
