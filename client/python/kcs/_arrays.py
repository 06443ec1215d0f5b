"""Types of arrays."""

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
IndexArray: TypeAlias = npt.NDArray[np.uint64]
LineArray: TypeAlias = npt.NDArray[np.uint32]
# Arrays whose elements have named fields.
Table: TypeAlias = npt.NDArray[Any]
