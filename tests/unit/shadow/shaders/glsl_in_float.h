#pragma once
#include <cmath>

/// The part of GLSL that prefiltered maps of shaders/shadow/filters are written in, with floats that stay floats.
/// Literals are doubles in C++, and would hide what rounding does.
namespace gnomon::glsl_in_float {

struct Real {
    float value = 0.0f;
    Real() = default;
    Real(double number) : value(static_cast<float>(number)) {}
    friend Real operator+(Real a, Real b) { return of(a.value + b.value); }
    friend Real operator-(Real a, Real b) { return of(a.value - b.value); }
    friend Real operator*(Real a, Real b) { return of(a.value * b.value); }
    friend Real operator/(Real a, Real b) { return of(a.value / b.value); }
    Real operator-() const { return of(-value); }
    friend bool operator<(Real a, Real b) { return a.value < b.value; }
    friend bool operator>(Real a, Real b) { return a.value > b.value; }
    friend bool operator<=(Real a, Real b) { return a.value <= b.value; }
    friend bool operator>=(Real a, Real b) { return a.value >= b.value; }

private:
    static Real of(float number) {
        Real real;
        real.value = number;
        return real;
    }
};

inline Real abs(Real a) { return std::abs(a.value); }
inline Real exp(Real a) { return std::exp(a.value); }
inline Real sqrt(Real a) { return std::sqrt(a.value); }
inline Real min(Real a, Real b) { return b < a ? b : a; }
inline Real max(Real a, Real b) { return a < b ? b : a; }
inline Real clamp(Real a, Real low, Real high) { return min(max(a, low), high); }

struct vec2 {
    Real x, y;
    vec2(Real x_, Real y_) : x(x_), y(y_) {}
};
struct vec3 {
    Real x, y, z;
    vec3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
};
struct vec4 {
    Real x, y, z, w;
    vec4() = default;
    vec4(Real x_, Real y_, Real z_, Real w_) : x(x_), y(y_), z(z_), w(w_) {}
};
inline vec4 mix(const vec4& a, const vec4& b, Real t) {
    const auto of = [&](Real p, Real q) { return p * (Real(1.0) - t) + q * t; };
    return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z), of(a.w, b.w)};
}

}  // namespace gnomon::glsl_in_float
