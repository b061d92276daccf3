# The sources of each library; paths relative to this folder.
set(DMP_core_SOURCES
  basis.cpp
  demonstration.cpp
  dmp.cpp
  file.cpp
  forcing.cpp
  orientation_dmp.cpp
  pose_dmp.cpp
  so3.cpp
  spline.cpp)
set(DMP_kinematics_SOURCES
  arm.cpp
  inverse_kinematics.cpp
  path_tracking.cpp
  time_scaling.cpp
  detail/urdf_chain.cpp)
