"""The table side: ball, cloth, cue and what happens when they meet (sections 1 to 4).

Everything is computed in SI units and radians (`units` has the players' units). Frames are
right-handed: x ahead, y to the left, z up. Along the shot, x' points where the cue ball goes;
at a collision, x points along the line of centres, from the cue ball to the object ball, and
the cue ball comes in at the cut angle to the left of it, so that a cut angle above 0 sends
the object ball to the right. A spin is J = R omega / V, one number for each axis: J_y = 1 is
natural roll, J_z above 0 is counterclockwise from above (right english), and outside english
on a cut to the right is negative.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "aimed": ["AimedShot", "aimed_shot"],
        "collision": ["Collision", "Jump", "axis_tilt", "collide"],
        "deflection": [
            "EnergyShares",
            "deflection",
            "deflection_slope",
            "energy_after_hit",
            "energy_in_roll",
            "largest_deflection_cut",
            "right_angle_cut",
            "split_cut",
            "split_roll_cut",
            "unit_slope_cut",
        ],
        "equipment": [
            "BALL_SETS",
            "BallSet",
            "LIQUIDS",
            "density_range",
            "floats_in",
            "volume_range",
        ],
        "friction": [
            "friction_of_incline",
            "friction_of_stop",
            "friction_of_throw",
            "miscue_offset",
            "sliding_distance",
            "sliding_power",
            "sliding_speed",
            "tip_friction_of",
        ],
        "leg": ["Leg", "Phase", "State"],
        "objects": ["Ball", "Cloth", "Cue", "Table"],
        "offset": [
            "ContactPoint",
            "NATURAL_ROLL_OFFSET",
            "ball_speed_ratio",
            "best_lag_offset",
            "contact_for_later",
            "effective_contact",
            "gearing_tip",
            "largest_roll_side",
            "offset_for",
            "roll_side",
            "roll_speed_ratio",
            "small_circle_point",
            "spin_of_offset",
            "strike_side",
            "stun_offset",
        ],
        "pocketed": ["pocketed_shot"],
        "pockets": ["POCKET_NAMES", "Pocket", "pockets"],
        "rolling": [
            "Energy",
            "MOON_GRAVITY",
            "SHAPES",
            "SpinStop",
            "kinetic_energy",
            "rolling_friction",
            "rolling_time",
            "spin_stop",
        ],
        "shot": ["Shot", "shot"],
        "slide": [
            "Slide",
            "drag_distance",
            "parabola",
            "roll_speed",
            "roll_velocity",
            "sliding_ball_speed",
            "stun_distance",
        ],
        "strike": ["Strike", "strike", "strike_for_speed"],
        "table_speed": [
            "TABLE_SPEEDS",
            "lag_distance",
            "lag_speed",
            "roll_distance",
            "roll_time",
            "table_speed",
        ],
        "throw": [
            "Aim",
            "BALL_FRICTION",
            "FRICTION_LAWS",
            "aim",
            "full_throw_cut",
            "gearing_side",
            "throw_angle",
            "throw_factor",
            "throw_sensitivity",
        ],
        "tip": [
            "CentreHit",
            "best_stick_ratio",
            "break_energy_share",
            "centre_hit",
            "energy_share",
            "stroke_energy",
            "stroke_speed",
        ],
    },
)
