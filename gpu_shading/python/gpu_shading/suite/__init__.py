"""Scores of shading tools on scenes with exact sunlit fractions: the command `gpu_shading suite`."""
