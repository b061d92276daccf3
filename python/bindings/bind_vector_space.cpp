#include "bind.hpp"
#include "bind_space.hpp"

namespace dmp::python {

void bind_vector_space(py::module_& m) { bind_space<VectorSpace, Run>(m); }

}  // namespace dmp::python
