# find_package(vtkSVO) after an installation.
