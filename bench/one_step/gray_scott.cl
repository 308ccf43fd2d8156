// A step of Gray and Scott's reaction in one cell (docs/one_step.md).
// lines: OpenCL, the kernel
kernel void gray_scott(global const float* restrict u, global const float* restrict v,
                 global float* restrict next_u, global float* restrict next_v) {
    const int i = get_global_id(0), k = get_global_id(1);
    const int n = get_global_size(0);
    const int left = k * n + (i == 0 ? n - 1 : i - 1), right = k * n + (i == n - 1 ? 0 : i + 1);
    const int above = (k == 0 ? n - 1 : k - 1) * n + i, below = (k == n - 1 ? 0 : k + 1) * n + i;
    const int c = k * n + i;
    const float rate = u[c] * v[c] * v[c];
    const float lap_u = u[left] + u[right] + u[above] + u[below] - 4 * u[c];
    const float lap_v = v[left] + v[right] + v[above] + v[below] - 4 * v[c];
    next_u[c] = u[c] + 0.16f * lap_u - rate + 0.037f * (1 - u[c]);
    next_v[c] = v[c] + 0.08f * lap_v + rate - (0.037f + 0.060f) * v[c];
}
// end
