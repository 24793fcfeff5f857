// Returns whether the light's shadows fall on a receiver of these layers (a bit per layer, 0 to 255).
bool takes_shadow(float shadow_layers) {
    return (uint(shadow_layers + 0.5) & uint(light.to_light.w + 0.5)) != 0u;
}
