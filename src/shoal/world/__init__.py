"""What nobody on board controls, as kernels: neighbors, sensing, motion, targets, placement."""
