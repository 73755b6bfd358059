#include "vtkMandelbulbFunction.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

vtkStandardNewMacro(vtkMandelbulbFunction);

namespace
{
/// A number with its derivatives by the three coordinates.
struct Dual
{
  double v;
  glm::dvec3 d{ 0.0 };
};
Dual operator+(const Dual& a, const Dual& b)
{
  return { a.v + b.v, a.d + b.d };
}
Dual operator-(const Dual& a, const Dual& b)
{
  return { a.v - b.v, a.d - b.d };
}
Dual operator*(const Dual& a, const Dual& b)
{
  return { a.v * b.v, a.v * b.d + b.v * a.d };
}
Dual operator/(const Dual& a, const Dual& b)
{
  return { a.v / b.v, (a.d - a.v / b.v * b.d) / b.v };
}

/// f(a), where the derivative of f there is known.
double chain(double, double f, double)
{
  return f;
}
Dual chain(const Dual& a, double f, double derivative)
{
  return { f, derivative * a.d };
}
double number(double a)
{
  return a;
}
double number(const Dual& a)
{
  return a.v;
}
/// At 0 without derivatives: on the z axis, and at the origin.
template <class T>
T root(const T& a)
{
  const double f = std::sqrt(number(a));
  return chain(a, f, f > 0.0 ? 0.5 / f : 0.0);
}
template <class T>
T logarithm(const T& a)
{
  return chain(a, std::log(number(a)), 1.0 / number(a));
}
double realPower(double a, double n)
{
  return std::pow(a, n);
}
Dual realPower(const Dual& a, double n)
{
  const double f = std::pow(a.v, n - 1.0);
  return chain(a, a.v * f, n * f);
}

template <class T>
struct Complex
{
  T re, im;
};
template <class T>
Complex<T> operator*(const Complex<T>& a, const Complex<T>& b)
{
  return { a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re };
}

/// By squaring; n > 0.
template <class T>
T wholePower(T a, unsigned n)
{
  while (!(n & 1))
  {
    a = a * a;
    n >>= 1;
  }
  T result = a;
  while (n >>= 1)
  {
    a = a * a;
    if (n & 1)
    {
      result = result * a;
    }
  }
  return result;
}

double argument(const Complex<double>& a)
{
  return std::atan2(a.im, a.re);
}
Dual argument(const Complex<Dual>& a)
{
  const double square = a.re.v * a.re.v + a.im.v * a.im.v;
  return { std::atan2(a.im.v, a.re.v),
    square > 0.0 ? (a.re.v * a.im.d - a.im.v * a.re.d) / square : glm::dvec3(0.0) };
}
template <class T>
Complex<T> turned(const T& angle, double n)
{
  const double c = std::cos(n * number(angle)), s = std::sin(n * number(angle));
  return { chain(angle, c, -n * s), chain(angle, s, n * c) };
}

/// a^n for a of length 1.
template <class T>
Complex<T> unitPower(const Complex<T>& a, double n, unsigned whole)
{
  return whole ? wholePower(a, whole) : turned(argument(a), n);
}

template <class T>
T estimate(const T c[3], double n, int iterations)
{
  constexpr double Escaped = 1e3; // from here on further iterations change less than 1e-6 of it
  const T one{ 1.0 }, half{ 0.5 };
  const unsigned whole = n == std::floor(n) ? static_cast<unsigned>(n) : 0;
  T z[3] = { c[0], c[1], c[2] };
  T derivative = one;
  T r = root(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
  for (int i = 0; i < iterations && number(r) <= Escaped && number(r) > 0.0; ++i)
  {
    const T fromAxis = root(z[0] * z[0] + z[1] * z[1]);
    const T perR = one / r;
    const Complex<T> theta{ perR * z[2], perR * fromAxis };
    Complex<T> phi{ one, T{ 0.0 } }; // on the axis
    if (number(fromAxis) > 0.0)
    {
      const T perAxis = one / fromAxis;
      phi = { perAxis * z[0], perAxis * z[1] };
    }
    const Complex<T> nTheta = unitPower(theta, n, whole), nPhi = unitPower(phi, n, whole);
    const T before = whole ? wholePower(r, whole - 1) : realPower(r, n - 1.0);
    const T length = before * r;
    derivative = T{ n } * before * derivative + one;
    z[0] = length * nTheta.im * nPhi.re + c[0];
    z[1] = length * nTheta.im * nPhi.im + c[1];
    z[2] = length * nTheta.re + c[2];
    r = root(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
  }
  if (number(r) == 0.0)
  {
    r = T{ std::numeric_limits<double>::min() };
  }
  const T estimated = half * logarithm(r) / derivative;
  return number(r) > 1.0 ? r * estimated : estimated;
}
}

//------------------------------------------------------------------------------
double vtkMandelbulbFunction::EvaluateFunction(double x[3])
{
  return estimate(x, this->Power, this->NumberOfIterations);
}

//------------------------------------------------------------------------------
void vtkMandelbulbFunction::EvaluateGradient(double x[3], double g[3])
{
  const Dual c[3] = { { x[0], glm::dvec3(1.0, 0.0, 0.0) }, { x[1], glm::dvec3(0.0, 1.0, 0.0) },
    { x[2], glm::dvec3(0.0, 0.0, 1.0) } };
  const glm::dvec3 gradient = estimate(c, this->Power, this->NumberOfIterations).d;
  std::copy_n(&gradient.x, 3, g);
}

//------------------------------------------------------------------------------
void vtkMandelbulbFunction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Power: " << this->Power << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
}
