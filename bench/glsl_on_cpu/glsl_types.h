#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

/// The part of GLSL that shaders/shadow uses, with every float a double. cpu_lookup.cpp compiles the shaders' own text
/// with it, so that there is no second copy of the lookup. Names are GLSL's.
namespace gnomon::bench::glsl {

using uint = std::uint32_t;

struct vec2;

struct ivec2 {
    int x = 0, y = 0;
    ivec2() = default;
    ivec2(int x_, int y_) : x(x_), y(y_) {}
    explicit ivec2(const vec2& v);
};
struct ivec3 {
    int x = 0, y = 0, z = 0;
    ivec3() = default;
    ivec3(int x_, int y_, int z_) : x(x_), y(y_), z(z_) {}
    ivec3(const ivec2& v, int z_) : x(v.x), y(v.y), z(z_) {}
    ivec2 xy_() const { return {x, y}; }
};
struct ivec4 {
    int x = 0, y = 0, z = 0, w = 0;
};

struct uvec2 {
    uint x = 0, y = 0;
    constexpr uvec2() = default;
    constexpr uvec2(uint x_, uint y_) : x(x_), y(y_) {}
    bool operator==(const uvec2&) const = default;
};
struct uvec3 {
    uint x = 0, y = 0, z = 0;
    uvec3(uint x_, uint y_, uint z_) : x(x_), y(y_), z(z_) {}
};
struct uvec4 {
    uint x = 0, y = 0, z = 0, w = 0;
    constexpr uvec4() = default;
    constexpr explicit uvec4(uint s) : x(s), y(s), z(s), w(s) {}
    constexpr uvec4(uint x_, uint y_, uint z_, uint w_) : x(x_), y(y_), z(z_), w(w_) {}
    uint& operator[](int i) { return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w)); }
    uint operator[](int i) const { return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w)); }
    uvec2 xy_() const { return {x, y}; }
};

struct bvec4 {
    bool of[4] = {};
    bool& operator[](int i) { return of[i]; }
    bool operator[](int i) const { return of[i]; }
};

struct vec2 {
    static constexpr int kSize = 2;
    double x = 0.0, y = 0.0;
    vec2() = default;
    explicit vec2(double s) : x(s), y(s) {}
    constexpr vec2(double x_, double y_) : x(x_), y(y_) {}
    explicit vec2(const ivec2& v) : x(v.x), y(v.y) {}
    double& operator[](int i) { return i == 0 ? x : y; }
    double operator[](int i) const { return i == 0 ? x : y; }
    vec2 xy_() const { return *this; }
    vec2 yx_() const { return {y, x}; }
};
inline ivec2::ivec2(const vec2& v) : x(static_cast<int>(v.x)), y(static_cast<int>(v.y)) {}

struct vec3 {
    static constexpr int kSize = 3;
    double x = 0.0, y = 0.0, z = 0.0;
    vec3() = default;
    explicit vec3(double s) : x(s), y(s), z(s) {}
    constexpr vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    vec3(const vec2& v, double z_) : x(v.x), y(v.y), z(z_) {}
    double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
    double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
    vec2 xy_() const { return {x, y}; }
    vec3 xyz_() const { return *this; }
};

struct vec4 {
    static constexpr int kSize = 4;
    double x = 0.0, y = 0.0, z = 0.0, w = 0.0;
    vec4() = default;
    explicit vec4(double s) : x(s), y(s), z(s), w(s) {}
    vec4(double x_, double y_, double z_, double w_) : x(x_), y(y_), z(z_), w(w_) {}
    vec4(const vec3& v, double w_) : x(v.x), y(v.y), z(v.z), w(w_) {}
    vec4(const vec2& v, double z_, double w_) : x(v.x), y(v.y), z(z_), w(w_) {}
    vec4(const vec2& v, const vec2& u) : x(v.x), y(v.y), z(u.x), w(u.y) {}
    double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w)); }
    double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : (i == 2 ? z : w)); }
    vec2 xy_() const { return {x, y}; }
    vec2 zw_() const { return {z, w}; }
    vec3 xyz_() const { return {x, y, z}; }
};

template <class V>
concept Vector = requires {
    V::kSize;
};

template <Vector V, class F>
V each(const V& a, F f) {
    V r;
    for (int i = 0; i < V::kSize; ++i) r[i] = f(a[i]);
    return r;
}
template <Vector V, class F>
V each(const V& a, const V& b, F f) {
    V r;
    for (int i = 0; i < V::kSize; ++i) r[i] = f(a[i], b[i]);
    return r;
}

template <Vector V>
V operator-(const V& a) {
    return each(a, [](double p) { return -p; });
}
template <Vector V>
V operator+(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p + q; });
}
template <Vector V>
V operator-(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p - q; });
}
template <Vector V>
V operator*(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p * q; });
}
template <Vector V>
V operator/(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p / q; });
}
template <Vector V>
V operator+(const V& a, double s) {
    return a + V(s);
}
template <Vector V>
V operator-(const V& a, double s) {
    return a - V(s);
}
template <Vector V>
V operator*(const V& a, double s) {
    return a * V(s);
}
template <Vector V>
V operator/(const V& a, double s) {
    return a / V(s);
}
template <Vector V>
V operator+(double s, const V& a) {
    return V(s) + a;
}
template <Vector V>
V operator-(double s, const V& a) {
    return V(s) - a;
}
template <Vector V>
V operator*(double s, const V& a) {
    return V(s) * a;
}
template <Vector V>
V operator/(double s, const V& a) {
    return V(s) / a;
}
template <Vector V>
V& operator+=(V& a, const V& b) {
    return a = a + b;
}
template <Vector V>
V& operator-=(V& a, const V& b) {
    return a = a - b;
}
template <Vector V>
V& operator*=(V& a, double s) {
    return a = a * s;
}

using std::abs, std::cos, std::sin, std::sqrt, std::floor, std::ceil, std::exp, std::exp2, std::log, std::log2,
    std::pow, std::fma, std::acos, std::atan;
inline double atan(double y, double x) { return std::atan2(y, x); }
inline double min(double a, double b) { return b < a ? b : a; }
inline double max(double a, double b) { return a < b ? b : a; }
inline int min(int a, int b) { return std::min(a, b); }
inline int max(int a, int b) { return std::max(a, b); }
inline double clamp(double a, double low, double high) { return min(max(a, low), high); }
inline double mix(double a, double b, double t) { return a * (1.0 - t) + b * t; }
inline double fract(double a) { return a - floor(a); }
inline double sign(double a) { return a > 0.0 ? 1.0 : (a < 0.0 ? -1.0 : 0.0); }
inline double step(double edge, double a) { return a < edge ? 0.0 : 1.0; }
inline double smoothstep(double low, double high, double a) {
    const double t = clamp((a - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

template <Vector V>
V sqrt(const V& a) {
    return each(a, [](double p) { return std::sqrt(p); });
}
template <Vector V>
V abs(const V& a) {
    return each(a, [](double p) { return std::abs(p); });
}
template <Vector V>
V floor(const V& a) {
    return each(a, [](double p) { return std::floor(p); });
}
template <Vector V>
V fract(const V& a) {
    return a - floor(a);
}
template <Vector V>
V sign(const V& a) {
    return each(a, [](double p) { return sign(p); });
}
template <Vector V>
V min(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return min(p, q); });
}
template <Vector V>
V max(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return max(p, q); });
}
template <Vector V>
V min(const V& a, double s) {
    return min(a, V(s));
}
template <Vector V>
V max(const V& a, double s) {
    return max(a, V(s));
}
template <Vector V>
V clamp(const V& a, double low, double high) {
    return min(max(a, low), high);
}
template <Vector V>
V clamp(const V& a, const V& low, const V& high) {
    return min(max(a, low), high);
}
template <Vector V>
V mix(const V& a, const V& b, double t) {
    return a * (1.0 - t) + b * t;
}

template <Vector V>
double dot(const V& a, const V& b) {
    double sum = 0.0;
    for (int i = 0; i < V::kSize; ++i) sum += a[i] * b[i];
    return sum;
}
template <Vector V>
double length(const V& a) {
    return sqrt(dot(a, a));
}
template <Vector V>
double distance(const V& a, const V& b) {
    return length(a - b);
}
template <Vector V>
V normalize(const V& a) {
    return a / length(a);
}
inline vec3 cross(const vec3& a, const vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Compares componentwise: 1 or 0 in each component.
template <Vector V>
V greaterThanEqual(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p >= q ? 1.0 : 0.0; });
}
template <Vector V>
V greaterThan(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p > q ? 1.0 : 0.0; });
}
template <Vector V>
V lessThanEqual(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p <= q ? 1.0 : 0.0; });
}
template <Vector V>
V lessThan(const V& a, const V& b) {
    return each(a, b, [](double p, double q) { return p < q ? 1.0 : 0.0; });
}
template <Vector V>
bool all(const V& a) {
    for (int i = 0; i < V::kSize; ++i)
        if (a[i] == 0.0) return false;
    return true;
}
template <Vector V>
bool any(const V& a) {
    return dot(a, a) > 0.0;
}
template <Vector V>
V isnan(const V& a) {
    return each(a, [](double p) { return std::isnan(p) ? 1.0 : 0.0; });
}
template <Vector V>
V isinf(const V& a) {
    return each(a, [](double p) { return std::isinf(p) ? 1.0 : 0.0; });
}
inline double uintBitsToFloat(uint bits) { return static_cast<double>(std::bit_cast<float>(bits)); }
inline int bitCount(uint bits) { return std::popcount(bits); }
inline int findLSB(uint bits) { return bits != 0 ? std::countr_zero(bits) : -1; }
inline bvec4 equal(const uvec4& a, const uvec4& b) { return {{a.x == b.x, a.y == b.y, a.z == b.z, a.w == b.w}}; }
inline bool any(const bvec4& a) { return a[0] || a[1] || a[2] || a[3]; }

struct mat3 {
    vec3 columns[3];
    mat3() = default;
    mat3(const vec3& a, const vec3& b, const vec3& c) : columns{a, b, c} {}
    const vec3& operator[](int i) const { return columns[i]; }
};
inline vec3 operator*(const mat3& m, const vec3& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
inline vec3 operator*(const vec3& v, const mat3& m) { return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])}; }

struct mat4 {
    vec4 columns[4];
    vec4& operator[](int i) { return columns[i]; }
    const vec4& operator[](int i) const { return columns[i]; }
};
inline vec4 operator*(const mat4& m, const vec4& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * v.w; }

/// Contents of a `readonly buffer`. Copies share them.
template <class T>
struct StorageBuffer {
    using Element = T;
    std::shared_ptr<const std::vector<T>> elements;
    const T& operator[](uint i) const { return (*elements)[i]; }
};
/// Base of the blocks that declare them: C++ wants something before an open array.
struct UnmadeBlock {
    uint begins = 0;
};

}  // namespace gnomon::bench::glsl
