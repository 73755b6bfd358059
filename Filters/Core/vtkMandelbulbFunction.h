/**
 * @class vtkMandelbulbFunction
 * @brief the Mandelbulb, as an implicit function
 *
 * The set of points c of which z -> z^n + c, from z = c on, does not escape. Powers of vectors are
 * those of D. White and P. Nylander (2009): in spherical coordinates (r, theta from the z axis,
 * phi around it) z^n is r^n at the angles n theta and n phi.
 *
 * The value is the distance estimate 0.5 r log(r) / r', after J. C. Hart, D. J. Sandin and L. H.
 * Kauffman, "Ray Tracing Deterministic 3-D Fractals", SIGGRAPH 1989, where r is the length of the
 * last z and r' that of its derivative, by r' -> n r^(n-1) r' + 1: positive outside, negative
 * inside (there it is 0.5 log(r) / r', so that it has no zero where z goes to 0). The surface at
 * the value 0 is where z has length 1 after the last iteration: it is smooth for any number of
 * iterations, and has more detail the more there are.
 *
 * Outside the estimate is in general less than the distance, but there is no proof: r' is the
 * derivative along the radius, and others can be n times as large. So leave the gradient bound of
 * vtkImplicitFunctionToSVO at 0: with 1 a twentieth of the voxels is missed.
 *
 * The surface lies within 2^(1/(n - 1)) of the origin, for any number of iterations: from there on
 * all z grow. That is 2 for a power of 2, 1.26 for 4, and 1.11 for 8.
 * With a power that is no whole number it is torn along the half plane y = 0, x < 0, where phi
 * jumps.
 *
 * May be asked by several threads at a time.
 *
 * @sa vtkImplicitFunctionToSVO
 */
#ifndef vtkMandelbulbFunction_h
#define vtkMandelbulbFunction_h

#include "vtkImplicitFunction.h"
#include "vtkSVOCoreModule.h" // for the export macro

class VTKSVOCORE_EXPORT vtkMandelbulbFunction : public vtkImplicitFunction
{
public:
  static vtkMandelbulbFunction* New();
  vtkTypeMacro(vtkMandelbulbFunction, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The estimate at a point, and its gradient.
   */
  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;
  void EvaluateGradient(double x[3], double g[3]) override;
  //@}

  //@{
  /**
   * The power n; 2 to 32, values outside are clamped; default 8. Whole numbers take a third of the
   * time.
   */
  vtkSetClampMacro(Power, double, 2.0, 32.0);
  vtkGetMacro(Power, double);
  //@}

  //@{
  /**
   * How often z is replaced; 1 to 1000, values outside are clamped; default 8.
   */
  vtkSetClampMacro(NumberOfIterations, int, 1, 1000);
  vtkGetMacro(NumberOfIterations, int);
  //@}

protected:
  vtkMandelbulbFunction() = default;
  ~vtkMandelbulbFunction() override = default;

private:
  double Power = 8.0;
  int NumberOfIterations = 8;
};

#endif
